#pragma once

#include "grader/protocol/frame.h"

#include <cstddef>
#include <string>
#include <vector>

namespace carlo::grader {

/// A table of raw values for people: how many there are, then its first `most` rows (all for 0),
/// each value beside what it is, and so that it reads back the same.
///
/// `names` say what the values are: one a column; or, of a single column, what its rows are in
/// their order, where the last name holds for all rows that are left ("estimate" alone: each is
/// one). Where they say nothing that fits, values are called "value 1", "value 2" and so on.
std::string rows_text(const Rows& rows, std::vector<std::string> names, std::size_t most);

}  // namespace carlo::grader
