#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo::grader {

/// A table of raw values, row by row.
struct Rows {
  std::size_t columns = 0;
  std::vector<double> values;

  std::size_t count() const { return columns == 0 ? 0 : values.size() / columns; }
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// The single answer of a worker: a table, or the reason why there is none.
struct Frame {
  /// exhausted: the system's error for too many threads, whoever has them.
  enum class Status : std::uint32_t { rows = 0, error = 1, not_implemented = 2, exhausted = 3 };
  Status status = Status::rows;
  Rows rows;
  std::string text;
  std::string tag = {}, function = {};  ///< of the function that is not implemented
};

/// The largest frame that a judge reads, in bytes.
constexpr std::size_t max_frame_bytes = std::size_t{64} << 20;

/// Encodes the frame as bytes of this machine: a header of 32 (magic, status, columns, rows, bytes
/// of payload), then the values or the text. If something is not implemented, tag and function
/// precede the text, and the header holds their lengths instead of columns and rows.
std::string encode(const Frame& frame);

/// Decodes the frame that fills `bytes`; returns nothing if they are anything else: cut short, too
/// long, of impossible sizes. Never reads outside `bytes`.
std::optional<Frame> decode(std::string_view bytes);

/// What a worker says on stderr when its stack is full: these two, and between them the stack's
/// size in MB.
constexpr std::string_view stack_report = "the stack is full: ", stack_report_end = " MB";

}  // namespace carlo::grader
