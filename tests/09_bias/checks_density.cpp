// Checks of exercise 9.5.
