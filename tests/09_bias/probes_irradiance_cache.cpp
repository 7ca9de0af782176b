// Probes of exercise 9.7: they call the student's functions and return raw values; what the values
// should be stands in checks_irradiance_cache.cpp.
