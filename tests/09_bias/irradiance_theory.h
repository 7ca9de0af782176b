#pragma once

#include "09_bias/irradiance_cases.h"
#include "course/verdict/verdict.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

// The results of exercise 9.7's functions if they are right, and with typical mistakes.

namespace lab09_tests {

enum class Slip97 {
  none,
  // in record_error()
  root_missing,
  root_of_two,
  angle_missing,
  place_missing,
  angle_itself,
  sine,
  place_squared,
  place_times_distance,
  place_absolute,
  root_of_all,
  larger_alone,
  // in interpolate()
  weights_equal,
  weights_squared,
  weights_by_error,
  best_alone,
  not_divided,
  all_serve,
  in_front_serves,
  behind_is_refused,
  in_front_refused_at_once,
  hundredth_absolute,
  in_front_by_own_normal,
  in_front_by_records_normal
};

/// A mistake and its diagnosis.
struct Told97 {
  Slip97 slip;
  carlo::Diagnosis diagnosis;
};

inline std::vector<Told97> error_slips97() {
  const carlo::Diagnosis angle{
      "angle-term-wrong", "the second summand is sqrt(1 - n . n'), which is |n - n'|/sqrt(2)."};
  return {
      {Slip97::root_missing,
       {"root-missing",
        "the root of 1 - n . n' is missing: for small angles this is far too small, since it "
        "falls with the square of the angle."}},
      {Slip97::root_of_two,
       {"root-of-two", "|n - n'| is sqrt(2) times too large: 1 - n . n' is |n - n'|^2/2."}},
      {Slip97::angle_missing,
       {"normals-forgotten",
        "the difference of the normals is ignored: a record would be used around every corner."}},
      {Slip97::place_missing, {"places-forgotten", "the distance to the record is ignored."}},
      {Slip97::angle_itself, angle},
      {Slip97::sine, angle},
      {Slip97::place_squared,
       {"squared-distance",
        "the first summand is |p - p'| over the record's distance, without squares."}},
      {Slip97::place_times_distance,
       {"multiplied-by-the-distance",
        "|p - p'| is multiplied by the record's distance; divide by it: light from far away "
        "varies slowly."}},
      {Slip97::place_absolute,
       {"distance-not-used",
        "divide |p - p'| by the record's distance: in a scene ten times as large the same error "
        "occurs ten times as far away."}},
      {Slip97::root_of_all, {"root-of-the-sum", "only 1 - n . n' is under the root."}},
      {Slip97::larger_alone,
       {"larger-summand-alone", "both summands count: their sum, not the larger one."}}};
}

inline std::vector<Told97> use_slips97() {
  const carlo::Diagnosis room{
      "in-front-without-room",
      "a record counts as in front by a distance that is not a hundredth of its own: with less, "
      "rounding makes holes in a plane; with more, a small record shines into hollows."};
  const carlo::Diagnosis one_normal{
      "in-front-by-one-normal",
      "the test for records in front uses one of the two normals; use their mean, (n + n')/2."};
  return {{Slip97::weights_equal,
           {"weights-equal", "all records have the same weight: it should be one over the error."}},
          {Slip97::weights_squared,
           {"weights-squared", "a record's weight is 1/error, not 1/error^2."}},
          {Slip97::weights_by_error,
           {"weights-upside-down",
            "records are weighted by their errors: the weight is one over the error."}},
          {Slip97::best_alone,
           {"best-record-alone", "only one record is used: average all that can be used."}},
          {Slip97::not_divided,
           {"not-divided-by-the-weights", "a weighted mean is divided by the sum of its weights."}},
          {Slip97::all_serve,
           {"error-not-limited", "a record is used although its error is not below `most`."}},
          {Slip97::in_front_serves,
           {"serves-from-in-front",
            "a record that lies in front is used: it may see what the point does not."}},
          {Slip97::behind_is_refused,
           {"in-front-the-wrong-way-round",
            "records behind the point are rejected, and those in front are used: (p' - p) points "
            "from the point to the record."}},
          {Slip97::in_front_refused_at_once, room},
          {Slip97::hundredth_absolute, room},
          {Slip97::in_front_by_own_normal, one_normal},
          {Slip97::in_front_by_records_normal, one_normal}};
}

inline double error97(const KnownRecord& r, Vec3 p, Vec3 n, Slip97 slip) {
  const double away = glm::length(Double3(p) - Double3(r.p)), place = away / r.distance;
  const double apart = glm::length(Double3(n) - Double3(r.n)), turn = apart / std::sqrt(2.0);
  const double angle = 2 * std::asin(std::min(apart / 2, 1.0));
  switch (slip) {
    case Slip97::root_missing:
      return place + turn * turn;
    case Slip97::root_of_two:
      return place + apart;
    case Slip97::angle_missing:
      return place;
    case Slip97::place_missing:
      return turn;
    case Slip97::angle_itself:
      return place + angle;
    case Slip97::sine:
      return place + std::sin(angle);
    case Slip97::place_squared:
      return place * place + turn;
    case Slip97::place_times_distance:
      return away * r.distance + turn;
    case Slip97::place_absolute:
      return away + turn;
    case Slip97::root_of_all:
      return std::sqrt(place + turn * turn);
    case Slip97::larger_alone:
      return std::max(place, turn);
    default:
      return place + turn;
  }
}

inline double weight97(double error, Slip97 slip) {
  if (slip == Slip97::weights_equal) return 1;
  if (slip == Slip97::weights_squared) return 1 / (error * error);
  return slip == Slip97::weights_by_error ? error : 1 / error;
}

inline bool refused97(const KnownRecord& r, Vec3 p, Vec3 n, Slip97 slip) {
  if (slip == Slip97::in_front_serves) return false;
  Double3 up = (Double3(n) + Double3(r.n)) / 2.0;
  if (slip == Slip97::in_front_by_own_normal) up = Double3(n);
  if (slip == Slip97::in_front_by_records_normal) up = Double3(r.n);
  const double above = glm::dot(Double3(r.p) - Double3(p), up);
  if (slip == Slip97::behind_is_refused) return -above > r.distance / 100;
  if (slip == Slip97::in_front_refused_at_once) return above > 0;
  return above > (slip == Slip97::hundredth_absolute ? 0.01 : r.distance / 100);
}

inline std::optional<Double3> interpolated97(std::span<const KnownRecord> records, Vec3 p, Vec3 n,
                                             double most, Slip97 slip) {
  Double3 sum(0);
  double weights = 0, least = endless;
  for (const KnownRecord& r : records) {
    const double error = error97(r, p, n, slip);
    if (slip != Slip97::all_serve && !(error < most)) continue;
    if (refused97(r, p, n, slip)) continue;
    if (error == 0) return Double3(r.E);
    const double weight = weight97(error, slip);
    if (slip == Slip97::best_alone && error < least) sum = Double3(0), weights = 0;
    if (slip == Slip97::best_alone && error > least) continue;
    least = std::min(least, error);
    sum += weight * Double3(r.E);
    weights += weight;
  }
  if (weights == 0) return std::nullopt;
  return slip == Slip97::not_divided ? sum : sum / weights;
}

}  // namespace lab09_tests
