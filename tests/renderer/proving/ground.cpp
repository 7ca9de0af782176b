#include "proving/ground.h"

#include <iterator>

namespace proving {

std::vector<Proof> proving_ground() {
  std::vector<Proof> all;
  for (const auto& family :
       {sky_proofs, open_furnace_proofs, furnace_proofs, furnished_furnace_proofs, emitter_proofs,
        leak_proofs, spot_proofs, light_proofs, polished_proofs, combination_proofs,
        light_pair_proofs, light_crowd_proofs, light_choice_proofs}) {
    std::vector<Proof> proofs = family();
    std::move(proofs.begin(), proofs.end(), std::back_inserter(all));
  }
  return all;
}

/// FNV-1a.
std::uint64_t hash_of(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

}  // namespace proving
