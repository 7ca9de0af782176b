// Checks of exercise 9.2.
