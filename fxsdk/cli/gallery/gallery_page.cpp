#include "fxsdk/cli/gallery/gallery_page.h"

#include <algorithm>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr std::string_view kStyle = R"(
  :root { color-scheme: light dark }
  body { font: 16px/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 1600px; padding: 0 12px 24px }
  h1 { font-size: 1.5rem; margin: 16px 0 4px }
  h2 { font-size: 1.15rem; margin: 8px 0 4px }
  nav { margin-bottom: 12px }
  nav a { display: inline-block; padding: 4px 8px 4px 0 }
  main { display: grid; gap: 16px; grid-template-columns: repeat(auto-fill, minmax(min(100%, 420px), 1fr)) }
  article { border: 1px solid #8886; border-radius: 8px; display: flex; flex-direction: column; overflow: hidden; padding-bottom: 8px }
  article > a + a { margin-top: 2px }
  article > pre { margin-bottom: 4px; margin-top: auto }
  article > :not(a):not(img) { margin-left: 12px; margin-right: 12px }
  img { display: block; height: auto; width: 100% }
  .tag { border: 1px solid #8888; border-radius: 10px; display: inline-block; font-size: .8rem; margin: 2px 4px 2px 0; padding: 0 8px }
  dl { display: grid; gap: 2px 12px; grid-template-columns: auto 1fr; margin: 8px 12px }
  dt { opacity: .75 } dd { margin: 0 }
  pre { background: #8882; border-radius: 4px; overflow-wrap: anywhere; padding: 6px 8px; white-space: pre-wrap }
  .note { font-size: .85rem; opacity: .75 }
)";

std::string formatted(const char* format, double value)
{
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Three significant digits, and all before the point; from 10 s on in seconds.
std::string milliseconds(double value)
{
    if (value >= 10000.0)
        return formatted("%.3g", value / 1000.0) + " s";
    return formatted(value < 100.0 ? "%.3g" : "%.0f", value) + " ms";
}

std::string seconds(double value)
{
    return formatted("%.3g", value) + " s";
}

std::string bytes(uint64_t value)
{
    const double count = double(value);
    if (count < 1024.0)
        return formatted("%.0f", count) + " bytes";
    return count < 1024.0 * 1024.0 ? formatted("%.3g", count / 1024.0) + " KiB"
                                   : formatted("%.4g", count / (1024.0 * 1024.0)) + " MiB";
}

std::string timesOf(const GalleryEntry& entry)
{
    std::string text;
    for (const double time : entry.times)
        text += (text.empty() ? "" : ", ") + seconds(time);
    return text;
}

void addImage(std::string& io, const std::string& file, int width, int height, const std::string& text)
{
    io += "<a href=\"" + escapedLink(file) + "\"><img loading=\"lazy\" src=\"" + escapedLink(file) +
          "\" width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(height) + "\" alt=\"" +
          escapedHtml(text) + "\"></a>\n";
}

void addRow(std::string& io, const char* what, const std::string& value)
{
    io += std::string("<dt>") + what + "</dt><dd>" + escapedHtml(value) + "</dd>\n";
}

void addEntry(std::string& io, const GalleryEntry& entry, const GalleryOptions& options)
{
    io += "<article id=\"" + escapedLink(entry.name) + "\">\n";
    addImage(io, pictureName(entry), options.width, options.height,
             entry.name + " at " + seconds(entry.time));
    if (!entry.strip.empty()) {
        const int side = options.width / options.times;
        addImage(io, stripName(entry), side * options.times,
                 std::max(options.height * side / options.width, 1), entry.name + " at " + timesOf(entry));
    }
    io += "<h2>" + escapedHtml(entry.name) + "</h2>\n<div>";
    for (const std::string& tag : entry.tags)
        io += "<span class=\"tag\">" + escapedHtml(tag) + "</span>";
    io += "</div>\n";
    if (!entry.description.empty())
        io += "<p>" + escapedHtml(entry.description) + "</p>\n";
    io += "<dl>\n";
    addRow(io, "shown at", seconds(entry.time) + (entry.strip.empty() ? "" : "; strip at " + timesOf(entry)));
    addRow(io, "particles", std::to_string(entry.particles));
    addRow(io, "frame", milliseconds(entry.frameMilliseconds));
    addRow(io, "update", milliseconds(entry.updateMilliseconds));
    addRow(io, "memory",
           bytes(entry.memory) + " an instance at most, " + bytes(entry.textures) + " of textures");
    io += "</dl>\n<pre>" + escapedHtml(commandOf(entry)) + "</pre>\n</article>\n";
}

/// A word of a command line as the shell takes it.
std::string quoted(const std::string& word)
{
    constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-/:+,@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos)
        return word;
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

} // namespace

std::string escapedHtml(std::string_view text)
{
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            result += uint8_t(c) < 0x20 || c == 0x7F ? ' ' : c;
        }
    return result;
}

std::string escapedLink(std::string_view name)
{
    constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
    std::string result;
    for (const char c : name) {
        char code[4];
        std::snprintf(code, sizeof code, "%%%02X", unsigned(uint8_t(c)));
        result += kPlain.find(c) == std::string_view::npos ? std::string(code) : std::string(1, c);
    }
    return result;
}

std::string pictureName(const GalleryEntry& entry)
{
    return entry.name + ".png";
}

std::string stripName(const GalleryEntry& entry)
{
    return entry.name + ".strip.png";
}

std::string commandOf(const GalleryEntry& entry)
{
    return "fx render " + quoted(entry.input) + " -o " + quoted(pictureName(entry));
}

std::string galleryPage(std::span<const GalleryEntry> entries, const GalleryOptions& options,
                        const Machine& machine)
{
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                       "<title>fxsdk effects</title>\n<style>";
    page += kStyle;
    page +=
        "</style>\n</head>\n<body>\n<h1>fxsdk effects</h1>\n<p class=\"note\">fxsdk " FXSDK_VERSION ", " +
        std::to_string(entries.size()) + (entries.size() == 1 ? " preset" : " presets") + ". Measured on " +
        escapedHtml(toText(machine)) + ", pictures of " + std::to_string(options.width) + " x " +
        std::to_string(options.height) +
        " pixels: frame is stage and effect until the GPU has finished, update is a step of 1/60 s; medians. "
        "The person in pictures is 1.8 m tall.</p>\n<nav>";
    for (const GalleryEntry& entry : entries)
        page += "<a href=\"#" + escapedLink(entry.name) + "\">" + escapedHtml(entry.name) + "</a>\n";
    page += "</nav>\n<main>\n";
    for (const GalleryEntry& entry : entries)
        addEntry(page, entry, options);
    return page + "</main>\n</body>\n</html>\n";
}

} // namespace fx::cli
