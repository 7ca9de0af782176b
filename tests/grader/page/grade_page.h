#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <utility>
#include <vector>

namespace carlo::grader {

/// The words around the verdicts.
struct PageWords {
  std::string title;          ///< "Lab 07", or a submission's name
  std::string subtitle = {};  ///< empty: the points in all
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< lines of the foot
};

/// The page of one lab's verdicts, or of a list of labs': one HTML file that needs nothing else.
/// The verdicts are those of report_json(); what is missing in them is left out. In a list they may
/// also stand in a grading's record, as "verdict", beside its "note" and what the "compiler" said.
/// All text is escaped, and the page is valid UTF-8, whatever a student's program said.
std::string grade_page(const nlohmann::json& labs, const PageWords& words);

/// Whether a page helps: some exercise has neither passed nor been left undone.
bool something_failed(const nlohmann::json& lab);

}  // namespace carlo::grader
