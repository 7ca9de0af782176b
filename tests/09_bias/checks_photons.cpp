// Checks of exercise 9.4.
