// Checks of exercise 9.6.
