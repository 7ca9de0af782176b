#include "grader/protocol/frame.h"

#include <cstring>

namespace carlo::grader {
namespace {

constexpr std::uint64_t magic_word = 0x314D5246'4C524143;  // "CARLFRM1"

struct Header {
  std::uint64_t magic = magic_word;
  std::uint32_t status = 0;
  std::uint32_t columns = 0;
  std::uint64_t rows = 0;
  std::uint64_t bytes = 0;
};
static_assert(sizeof(Header) == 32);

}  // namespace

std::string encode(const Frame& frame) {
  const bool table = frame.status == Frame::Status::rows;
  Header header;
  header.status = static_cast<std::uint32_t>(frame.status);
  const std::string text = frame.tag + frame.function + frame.text;
  header.columns = static_cast<std::uint32_t>(table ? frame.rows.columns : frame.tag.size());
  header.rows = table ? frame.rows.count() : frame.function.size();
  header.bytes = table ? frame.rows.values.size() * sizeof(double) : text.size();
  std::string bytes(sizeof(Header) + header.bytes, '\0');
  std::memcpy(bytes.data(), &header, sizeof(Header));
  if (header.bytes == 0) return bytes;
  const void* payload = text.data();
  if (table) payload = frame.rows.values.data();
  std::memcpy(bytes.data() + sizeof(Header), payload, header.bytes);
  return bytes;
}

std::optional<Frame> decode(std::string_view bytes) {
  Header header;
  if (bytes.size() < sizeof(Header) || bytes.size() > max_frame_bytes) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof(Header));
  const std::string_view payload = bytes.substr(sizeof(Header));
  if (header.magic != magic_word || header.bytes != payload.size()) return std::nullopt;
  if (header.status > static_cast<std::uint32_t>(Frame::Status::exhausted)) {
    return std::nullopt;
  }
  Frame frame;
  frame.status = static_cast<Frame::Status>(header.status);
  const bool plain =
      frame.status == Frame::Status::error || frame.status == Frame::Status::exhausted;
  if (plain && (header.columns != 0 || header.rows != 0)) return std::nullopt;
  if (frame.status != Frame::Status::rows) {
    if (header.columns > payload.size()) return std::nullopt;
    if (header.rows > payload.size() - header.columns) return std::nullopt;
    frame.tag = payload.substr(0, header.columns);
    frame.function = payload.substr(header.columns, header.rows);
    frame.text = payload.substr(header.columns + header.rows);
    return frame;
  }
  // The payload bounds rows and columns separately, so their product cannot overflow.
  const std::uint64_t values = payload.size() / sizeof(double);
  if (header.columns > values || header.rows > values) return std::nullopt;
  if (header.columns * header.rows * sizeof(double) != payload.size()) return std::nullopt;
  frame.rows.columns = header.columns;
  frame.rows.values.resize(values);
  if (values > 0) std::memcpy(frame.rows.values.data(), payload.data(), payload.size());
  return frame;
}

}  // namespace carlo::grader
