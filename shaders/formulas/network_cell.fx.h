/// @formula network-cell
/// Light in an even cell of an illumination network, and what of its scattering counts as scattered.
///
/// symbol     unit     meaning
///   tau, T   1        optical depth of a line's way through the cell without the forward peak; exp(-tau)
///   a, u     1        share of the way's light that is replaced at its end, and in the mean over it
///   g, f     1        mean cosine of the phase function; share of the scattering that counts as going straight on
///   w        1        albedo
///   F, t, d  ., 1, 1  light of a source; optical depth up to a way through the medium, and along it
///   J0, J1   .        first moment of the light; the next three times the direction to the eye
///   S        .        light that is scattered to the eye, per extinction
/// @derivation
///   a = 1 - T,  u = 1 - (1 - T) / tau                                                             (1)
///   Where tau is below 0.5 both come from the series of u, or rounding would take their digits:
///       u = tau / 2! - tau^2 / 3! + tau^3 / 4! - ..., a = tau (1 - u)                             (2)
///   f is the smallest share for which a phase function of two bands is nowhere negative, and for g >= 0
///   matches a third moment where it can:
///       f = max(g^2, (3 g - 1) / 2), 0 for g <= 0                                                 (3)
///   The bands of the phase function with its peak are 1 and g again, whatever f is: what the network calls
///   straight on reaches the eye as well,
///       S = w max(J0 Y0 + g J1 Y1, 0),  Y0 = (4 pi)^(-1/2), Y1 = (4 pi / 3)^(-1/2)                (4)
///   Light of a source that has met the peak alone has F exp(-(1 - w f) t) at an optical depth t. It is
///   scattered to the eye by the whole phase function. With f = g^2 that gives the second order its first
///   three bands                                                                                  (5)
///   A cell in which light of a source is scattered for the first time is even in the network, the medium
///   in it is not: its lit rim shades the rest. The light that counts is the mean over the medium. On a
///   way into which light comes at the depth t, and on which the depth grows by d, that is
///       F exp(-(1 - w f) t) (1 - u((1 - w f) d))                                                   (6)
///   Ways of a cell count by their d. Then what a beam loses in a cell is what the cell scatters and
///   absorbs.
/// @source    [JWW76] delta-M; (2) is elementary; (4) and (5) are own
/// @deviation (4) has two bands, (5) the peak at no angle
/// @valid     tau >= 0; T = exp(-tau); -0.3 <= g <= 0.98
/// @accuracy  float within 5e-7 of double, relative; GLSL within 2e-6
/// @tests     tests/rendering/network/test_network_basis.cpp, tests/rendering/network/test_network_passes.cpp
FX_FORMULA(fxNetworkMean)(FX_REAL tau, FX_REAL T)
{
    FX_REAL n = FX_REAL(1.0) / FX_REAL(5040.0) - tau / FX_REAL(40320.0);
    n = FX_REAL(1.0) / FX_REAL(720.0) - tau * n;
    n = FX_REAL(1.0) / FX_REAL(120.0) - tau * n;
    n = FX_REAL(1.0) / FX_REAL(24.0) - tau * n;
    n = FX_REAL(1.0) / FX_REAL(6.0) - tau * n;
    FX_REAL thin = tau * (FX_REAL(0.5) - tau * n);                                       // (2)
    FX_REAL thick = FX_REAL(1.0) - (FX_REAL(1.0) - T) / max(tau, FX_REAL(0.5));          // (1)
    return tau < FX_REAL(0.5) ? thin : thick;
}

FX_FORMULA(fxNetworkTaken)(FX_REAL tau, FX_REAL T)
{
    return tau < FX_REAL(0.5) ? tau * (FX_REAL(1.0) - fxNetworkMean(tau, T)) : FX_REAL(1.0) - T; // (1), (2)
}

FX_FORMULA(fxNetworkPeak)(FX_REAL g)
{
    return g > FX_REAL(0.0) ? max(g * g, FX_REAL(1.5) * g - FX_REAL(0.5)) : FX_REAL(0.0); // (3)
}

FX_FORMULA(fxNetworkSource)(FX_REAL w, FX_REAL g, FX_REAL J0, FX_REAL J1)
{
    return w * max(FX_REAL(0.28209479177387814) * J0 + FX_REAL(0.48860251190291992) * g * J1, FX_REAL(0.0)); // (4)
}
