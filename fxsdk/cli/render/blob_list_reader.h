/// @file blob_list_reader.h
/// Lists of blobs (`*.blobs.csv`) for experiments with renderers.
///
/// The first line is `x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb`, optionally followed by `,g`.
/// All further lines have the same number of values. The extinction of a blob is tau_area W(r; radius) with
/// the quartic kernel W. The blob emits (1 - albedo) e per unit of optical depth, with e = (er, eg, eb). The
/// blob scatters by the Henyey-Greenstein phase function with the mean cosine g. Without the column `g`, g is
/// 0.
#pragma once

#include "foundation/result/status.h"
#include "rendering/reference/render/medium_blobs.h"

#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

constexpr uint64_t kBlobListBytes = uint64_t(1) << 30;

/// Parses a list of blobs.
/// @param name name of the file, for messages
/// @return Parse, with file, line and column, for another header, too few or too many numbers, a word that is
///         not a number, or a number outside its range (radius > 0, tau_area >= 0, albedo 0..1, e >= 0, g
///         -0.99..0.99, all below 1e12)
base::Result<std::vector<render::MediumBlob>> readBlobList(std::string_view text, const std::string& name);

/// Reads the list from a file. @return the codes of readBlobList(), NotFound, Io, TooLarge
base::Result<std::vector<render::MediumBlob>> loadBlobList(const std::string& path);

} // namespace fx::cli
