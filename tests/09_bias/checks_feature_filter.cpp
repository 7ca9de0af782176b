// Checks of exercise 9.3.
