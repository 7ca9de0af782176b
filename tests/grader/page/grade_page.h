#pragma once

#include "course/verdict/verdict.h"

#include <string>
#include <utility>
#include <vector>

namespace carlo::grader {

/// The text around the verdicts.
struct PageWords {
  std::string title;          ///< "Lab 07", or a submission's name
  std::string subtitle = {};  ///< empty: the total points
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< lines at the foot
};

/// One lab on a page.
struct LabPage {
  LabResult result;
  std::string note = {};      ///< why it was not judged, or files left out
  std::string compiler = {};  ///< its messages
};

/// Returns the page of one or several labs' verdicts: one HTML file that needs nothing else.
/// Escapes all text; the page is valid UTF-8 if the results are.
std::string grade_page(const std::vector<LabPage>& labs, const PageWords& words);

/// Returns whether a page helps: some exercise has neither passed nor been left undone.
bool something_failed(const LabResult& lab);

}  // namespace carlo::grader
