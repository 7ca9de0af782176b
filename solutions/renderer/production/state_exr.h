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

// How an EXR holds the state of a render, to go on from, to merge with others, or both: the
// settings and counts as attributes, and the film's sums, which are whole numbers of 128 bits, in
// channels of 32 bits. No bit is lost: the film goes on as if it had never been away. Channels that
// are 0 in all pixels are left out. An attribute "digest" tells whether anything has changed since.

namespace carlo {

/// Adds a state to an image. `lamp_ties` as in RenderResult.
void add_state(ExrFile& file, const RenderSettings& settings, const Film& film,
               const Counts& counts, const ExactSum& lamp_ties = {});

/// The same of an adaptive render.
void add_state(ExrFile& file, const RenderSettings& settings, const AdaptiveState& state,
               const Counts& counts);

/// Adds that the state is a part of a render; lines without samples are left out.
void add_part(ExrFile& file, const Part& part);

/// Adds the digest, when all else is there.
void seal(ExrFile& file);

/// Seals it and writes it in one step. Throws Error.
void write_state(const std::filesystem::path& path, ExrFile file);

/// The channels of such a film; of any state, those of adaptive ones among them.
std::vector<std::string> film_channels();
std::vector<std::string> state_channels();

/// Of all that a file was read to.
std::string digest_of(const ExrFile& file);

/// Adds the sums of a file, as far as it has channels for them, to a film of its size and block.
void add_film(const ExrFile& file, Film& film);

/// All that a sum holds: its words, in decimal.
std::string words_of(const ExactSum& sum);
/// Nothing if the text is none.
std::optional<ExactSum> sum_of_words(std::string_view text);

}  // namespace carlo
