#pragma once

#include "../peer_scene.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

// Which quantity of another renderer is which of ours: small scenes, rendered by both.

namespace bench {

/// A scene of ours and its value. Largest coordinates of `shared` and `stand_in` lie in [1/2, 1),
/// so that peer_scene() leaves them as they are.
struct Known {
  std::string shared;                        ///< XML that both renderers get: camera, shapes
  std::string ours = {};                     ///< XML that only ours gets
  double exact = 0;                          ///< the value in closed form; NaN if there is none
  std::string stand_in = {};                 ///< XML that the peer gets in place of `ours`
  std::array<int, 4> window = {0, 0, 8, 8};  ///< the pixels whose mean is the value: x0, y0, x1, y1
};

/// One row of the table.
struct Convention {
  Peer peer;
  std::string what;  ///< unique among the peer's
  Known scene;
  std::string theirs;          ///< Python that only the peer gets (peers/conventions.py)
  double factor;               ///< theirs over ours, by the rule
  std::string rule;            ///< how to convert, or what the default does
  std::string reason = {};     ///< why the values differ although they should not
  std::uint32_t samples = 64;  ///< a pixel, in each of the peer's runs
};

constexpr double no_closed_form = std::numeric_limits<double>::quiet_NaN();

/// All rows: those of the three peers.
std::vector<Convention> conventions();
std::vector<Convention> mitsuba_rows();
std::vector<Convention> cycles_rows();
std::vector<Convention> luxcore_rows();
std::string name_of(Peer peer);

/// A mean and its standard error.
struct Estimate {
  double value = 0, standard_error = 0;
};

/// The difference in standard errors. Both are sums of floats: a relative error of 1e-5 counts as
/// one more standard error.
double z_of(const Estimate& a, const Estimate& b);

/// Our value, by `times` the row's samples a pixel; writes what it reads to `scratch`.
Estimate our_value(const Convention& row, const std::filesystem::path& scratch,
                   std::uint32_t times);

/// What peers/conventions.py reads, except for "runs", "seed" and "output".
nlohmann::json peer_task(const Convention& row, const std::filesystem::path& scratch);

}  // namespace bench
