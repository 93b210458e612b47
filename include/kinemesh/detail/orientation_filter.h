// The error bound of orientation(). Apart, for sources that must include nothing else.
#pragma once

#pragma GCC visibility push(default)
namespace kinemesh {

// With u = 2^-53 each difference and product is right within a factor 1 +- u, a product of differences l, r
// therefore within 3u + O(u^2) of |l|, |r|, and det = l - r within u of itself; a product that underflows is
// off by at most 2^-1075 more. So |det - exact| <= u |det| + (3u + O(u^2)) (|l| + |r|) + 2^-1073, and the
// sign is right once |det| exceeds 4u (|l| + |r|) + 2^-1022 [Shewchuk 1997, §4.3, with room for rounding the
// bound itself]. Overflow makes the bound infinite or either side NaN: the comparison fails and the exact way
// is taken. A compiler that takes one product and the difference together rounds once less: |det - exact|
// only gets smaller, so that inlined into others' code this holds whatever they say of contraction.
inline constexpr double orientation_error = 4.0 * 0x1p-53;
inline constexpr double underflow_error = 0x1p-1022;

// What |l - r| has to exceed, of the magnitudes of l and r; also of several at once.
template <class Number>
constexpr Number orientation_bound(const Number& l, const Number& r) {
  return orientation_error * (l + r) + underflow_error;
}

}  // namespace kinemesh
#pragma GCC visibility pop
