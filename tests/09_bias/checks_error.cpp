// Checks of exercise 9.1.
