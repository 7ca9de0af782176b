#pragma once

#include "course/verdict/verdict.h"

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

/// One lab on a page.
struct LabPage {
  LabResult result;
  std::string note = {};      ///< why it was not judged, or files left out
  std::string compiler = {};  ///< what it said
};

/// The page of one lab's verdicts, or of several labs': one HTML file that needs nothing else. All
/// text is escaped, and the page is valid UTF-8 where the results are.
std::string grade_page(const std::vector<LabPage>& labs, const PageWords& words);

/// Whether a page helps: some exercise has neither passed nor been left undone.
bool something_failed(const LabResult& lab);

}  // namespace carlo::grader
