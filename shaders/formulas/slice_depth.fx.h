/// @formula slice-depth
/// Optical depth within a slab between two light slices, from those of the slab and of its neighbors.
///
/// symbol    unit   meaning
///   d0      1      optical depth of the slab in front, >= 0
///   d       1      of this slab, >= 0
///   d1      1      of the slab behind, >= 0; all three are of one thickness
///   x       1      place in the slab, 0 to 1
///   m0, m1  1      density at the planes in front and behind, as depth of a slab of that density
///
/// @derivation
///   The density at a plane is the harmonic mean of those of the slabs on both sides, 0 where one of them is empty,
///       m0 = 2 d0 d/(d0 + d),   m1 = 2 d d1/(d + d1)                                                                 (1)
///   and the depth up to x is the cubic with these slopes that is 0 at x = 0 and d at x = 1,
///       x (1 - x)^2 m0 + x^2 (3 - 2 x) d - x^2 (1 - x) m1                                                            (2)
///   It never falls, since m0 and m1 are at most 2 d.
/// @source    [FRI84], the harmonic mean for equal distances
/// @deviation none
/// @valid     any d0, d, d1 >= 0; x 0 to 1
/// @accuracy  exact for even media; error of third order in the distance of planes where the density changes smoothly
/// @tests     tests/rendering/core/test_slice_depth.cpp
FX_FORMULA(fxSliceDepth)(FX_REAL d0, FX_REAL d, FX_REAL d1, FX_REAL x)
{
    FX_REAL m0 = FX_REAL(2.0) * d0 * d / max(d0 + d, FX_REAL(1e-30));                                                 // (1)
    FX_REAL m1 = FX_REAL(2.0) * d * d1 / max(d + d1, FX_REAL(1e-30));                                                 // (1)
    FX_REAL y = FX_REAL(1.0) - x;
    return x * y * y * m0 + x * x * (FX_REAL(3.0) - FX_REAL(2.0) * x) * d - x * x * y * m1;                           // (2)
}
