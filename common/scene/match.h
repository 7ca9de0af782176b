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

/// What the case gives that takes the variant's value. An alternative that is added is an error in
/// every place that does not say what becomes of it there: no case stands for several.
template <class Variant, class... Cases>
requires CaseForEachAlternative<Variant, Cases...>
decltype(auto) match(Variant&& variant, Cases... cases) {
  return std::visit(Overloaded{std::move(cases)...}, std::forward<Variant>(variant));
}

}  // namespace carlo
