#pragma once

#include "support/error.h"

#include <string>
#include <vector>

namespace carlo {

/// The errors of a scene's files. Reading continues after each of them, so that one run reports
/// all. Consequences of an error must not be reported again: the finder marks the element
/// (XmlElement::broken) or substitutes something for what follows.
class SceneErrors {
 public:
  void add(const PlacedError& error) { errors_.push_back(error); }

  /// Does `work` and keeps the PlacedError that it throws. Returns true if there was none.
  template <class Work>
  bool guard(const Work& work) {
    try {
      work();
      return true;
    } catch (const PlacedError& error) {
      add(error);
      return false;
    }
  }

  std::size_t count() const { return errors_.size(); }

  /// Registers a file that is read: errors are reported in the order of files, then of positions.
  void reads(const std::string& file) { files_.push_back(file); }

  /// Notes that something unreadable may have declared ids, parameters or the sensor; from then on
  /// they are not reported as missing.
  void lose_names() { names_lost_ = true; }
  bool names_lost() const { return names_lost_; }

  /// Throws one PlacedError with a line for each error, in order and without repeats; beyond 50 the
  /// last line counts the others. Does nothing if there are none.
  void raise() const;

 private:
  std::vector<PlacedError> errors_;
  std::vector<std::string> files_;
  bool names_lost_ = false;
};

}  // namespace carlo
