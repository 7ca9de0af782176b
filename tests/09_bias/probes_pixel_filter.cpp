// Probes of exercise 9.2: they call the student's functions and return raw values; what the values
// should be stands in checks_pixel_filter.cpp.
