/// @file gallery_page.h
/// The page of a gallery: one HTML file without scripts.
#pragma once

#include "fxsdk/cli/gallery/gallery_entry.h"
#include "fxsdk/cli/support/machine.h"

#include <span>
#include <string>
#include <string_view>

namespace fx::cli {

/// Escapes what HTML gives a meaning, and control codes.
std::string escapedHtml(std::string_view text);

/// Escapes what the path of a link must not contain.
std::string escapedLink(std::string_view name);

std::string pictureName(const GalleryEntry& entry); ///< file name of the picture
std::string stripName(const GalleryEntry& entry);   ///< file name of the strip

/// The command that renders the picture of an entry.
std::string commandOf(const GalleryEntry& entry);

/// UTF-8 text of the page, which refers to pictures in its own folder.
std::string galleryPage(std::span<const GalleryEntry> entries, const GalleryOptions& options,
                        const Machine& machine);

} // namespace fx::cli
