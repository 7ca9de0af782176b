#include "gsl_methods.h"

#include "support/error.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_monte_miser.h>
#include <gsl/gsl_monte_vegas.h>
#include <gsl/gsl_rng.h>

#include <cstddef>

namespace lab04 {

struct GslMethod::State {
  gsl_rng* rng = nullptr;
  gsl_monte_miser_state* miser = nullptr;
  gsl_monte_vegas_state* vegas = nullptr;
};

void GslMethod::Free::operator()(State* state) const {
  if (state->vegas != nullptr) gsl_monte_vegas_free(state->vegas);
  if (state->miser != nullptr) gsl_monte_miser_free(state->miser);
  if (state->rng != nullptr) gsl_rng_free(state->rng);
  delete state;
}

GslMethod::GslMethod(Kind kind, std::uint64_t seed) : kind_(kind), state_(new State) {
  gsl_set_error_handler_off();
  state_->rng = gsl_rng_alloc(gsl_rng_mt19937);
  state_->miser = gsl_monte_miser_alloc(2);
  state_->vegas = gsl_monte_vegas_alloc(2);
  if (state_->rng == nullptr || state_->miser == nullptr || state_->vegas == nullptr) {
    throw carlo::Error("GSL found no memory for its workspaces");
  }
  gsl_rng_set(state_->rng, seed);
}

double GslMethod::average(const Integrand& integrand, std::int64_t n) {
  double lower[2] = {0, 0}, upper[2] = {1, 1}, value = 0, error = 0;
  gsl_monte_function f = {[](double* x, std::size_t, void* of) {
                            return static_cast<const Integrand*>(of)->f(x[0], x[1]);
                          },
                          2, const_cast<Integrand*>(&integrand)};
  int status = 0;
  if (kind_ == Kind::miser) {
    gsl_monte_miser_init(state_->miser);
    status = gsl_monte_miser_integrate(&f, lower, upper, 2, static_cast<std::size_t>(n),
                                       state_->rng, state_->miser, &value, &error);
  } else {
    gsl_monte_vegas_init(state_->vegas);
    status = gsl_monte_vegas_integrate(&f, lower, upper, 2, static_cast<std::size_t>(n / 5),
                                       state_->rng, state_->vegas, &value, &error);
  }
  if (status != GSL_SUCCESS) throw carlo::Error("GSL says: {}", gsl_strerror(status));
  return value;
}

}  // namespace lab04
