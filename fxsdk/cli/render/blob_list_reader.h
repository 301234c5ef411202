/// @file blob_list_reader.h
/// Lists of blobs (`*.blobs.csv`) for experiments with renderers.
///
/// The first line is `x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb`, and `,g` may follow; every
/// other one has as many numbers. A blob's extinction is tau_area W(r; radius) with the quartic kernel; it
/// sends out (1 - albedo) e per optical depth, and scatters by Henyey and Greenstein's phase function of mean
/// cosine g, 0 without the column.
#pragma once

#include "foundation/result/status.h"
#include "rendering/reference/render/medium_blobs.h"

#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

constexpr uint64_t kBlobListBytes = uint64_t(1) << 30;

/// @param name of the file, for messages
/// @return Parse, with file, line and column: another header, too few or too many numbers, something that is
/// no
///   number or outside its range (radius > 0, tau_area >= 0, albedo 0..1, e >= 0, g -0.99..0.99, all below
///   1e12)
base::Result<std::vector<render::MediumBlob>> readBlobList(std::string_view text, const std::string& name);

/// The same for a file. @return also NotFound, Io, TooLarge
base::Result<std::vector<render::MediumBlob>> loadBlobList(const std::string& path);

} // namespace fx::cli
