#pragma once

#include "image/exr.h"
#include "image/film.h"
#include "numeric/exact_sum.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/part.h"
#include "renderer/production/settings.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// How an EXR holds the state of a render, to continue from, to merge with others, or both: the
// settings and counts as attributes, and the film's sums, which are whole numbers of 128 bits, in
// channels of 32 bits. No bit is lost, so the film continues as if it had never been written.
// Channels that are 0 in all pixels are left out. An attribute "digest" shows whether anything has
// changed since.

namespace carlo {

/// Adds a state to an image. `lamp_ties` as in RenderResult.
void add_state(ExrFile& file, const RenderSettings& settings, const Film& film,
               const Counts& counts, const ExactSum& lamp_ties = {});

/// The same for an adaptive render.
void add_state(ExrFile& file, const RenderSettings& settings, const AdaptiveState& state,
               const Counts& counts);

/// Marks the state as a part of a render; lines without samples are left out.
void add_part(ExrFile& file, const Part& part);

/// Adds the digest, after everything else.
void seal(ExrFile& file);

/// Seals the file and writes it in one step. Throws Error.
void write_state(const std::filesystem::path& path, ExrFile file);

/// The channels of a film; below, of any state, including adaptive ones.
std::vector<std::string> film_channels();
std::vector<std::string> state_channels();

/// Returns the digest of everything that was read from a file.
std::string digest_of(const ExrFile& file);

/// Adds the sums in a file, as far as it has channels for them, to a film of the same size and
/// block size.
void add_film(const ExrFile& file, Film& film);

/// Formats all words of a sum in decimal.
std::string words_of(const ExactSum& sum);
/// Returns nothing if the text is not such a sum.
std::optional<ExactSum> sum_of_words(std::string_view text);

}  // namespace carlo
