// Checks of exercise 9.7.
