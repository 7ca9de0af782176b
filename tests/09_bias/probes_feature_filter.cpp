// Probes of exercise 9.3: they call the student's functions and return raw values; what the values
// should be stands in checks_feature_filter.cpp.
