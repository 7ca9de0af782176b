#pragma once

#include "support/error.h"

#include <string>
#include <vector>

namespace carlo {

/// The errors of a scene's files. Reading goes on behind each of them, so that one run tells all.
/// What an error leaves undone must not be told of again: who finds one marks the element
/// (XmlElement::broken) or puts something in its place, for what follows.
class SceneErrors {
 public:
  void add(const PlacedError& error) { errors_.push_back(error); }

  /// Does `work` and keeps the PlacedError that it throws. Whether it threw none.
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

  /// That a file is read: errors are told in the order of files, then of places.
  void reads(const std::string& file) { files_.push_back(file); }

  /// That something could not be read that may have declared ids, parameters or the sensor: nobody
  /// misses them from then on.
  void lose_names() { names_lost_ = true; }
  bool names_lost() const { return names_lost_; }

  /// Throws one PlacedError that has a line for each error, in order and each once; of more than 50
  /// the last line counts the others. Does nothing when there is none.
  void raise() const;

 private:
  std::vector<PlacedError> errors_;
  std::vector<std::string> files_;
  bool names_lost_ = false;
};

}  // namespace carlo
