#pragma once

#include <type_traits>
#include <utility>
#include <variant>

namespace carlo {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

template <class Variant, class... Cases>
concept CaseForEachAlternative =
    sizeof...(Cases) == std::variant_size_v<std::remove_cvref_t<Variant>>;

/// The result of the case that takes the variant's value. Adding an alternative is a compile error
/// wherever it is not handled: no case covers several alternatives.
template <class Variant, class... Cases>
requires CaseForEachAlternative<Variant, Cases...>
decltype(auto) match(Variant&& variant, Cases... cases) {
  return std::visit(Overloaded{std::move(cases)...}, std::forward<Variant>(variant));
}

}  // namespace carlo
