/// @file exposure.h
/// Conversion from luminance to the values of a picture.
#pragma once

namespace fx::render {

/// Returns the factor that converts luminance to stored values, for an EV100 setting. A luminance of 1.2 *
/// 2^EV cd/m2 becomes 1 (ISO 12232, as used by [LdR14]).
float exposureFromEv100(float ev100);

} // namespace fx::render
