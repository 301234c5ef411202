#include "fxsdk/presets/emitters/mesh_text.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace fx::preset {

namespace {

/// Takes the next word off `line`; empty at its end.
std::string_view nextWord(std::string_view& line)
{
    const size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos)
        return line = {};
    const size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

bool readVertex(std::string_view line, MeshText& out)
{
    glm::vec3 p(0.0f);
    for (int k = 0; k < 3; ++k) {
        const std::string_view word = nextWord(line);
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), p[k]);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(p[k]))
            return false;
    }
    out.positions.push_back(p);
    return true;
}

/// The vertex that a corner such as 7, 7/1/2 or -1 names.
std::optional<uint32_t> cornerOf(std::string_view word, size_t vertices)
{
    int64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || (end != word.data() + word.size() && *end != '/'))
        return std::nullopt;
    const int64_t index = number > 0 ? number - 1 : int64_t(vertices) + number;
    if (number == 0 || index < 0 || index >= int64_t(vertices))
        return std::nullopt;
    return uint32_t(index);
}

bool readFace(std::string_view line, MeshText& out)
{
    uint32_t first = 0, before = 0;
    int corners = 0;
    for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line), ++corners) {
        const std::optional<uint32_t> corner = cornerOf(word, out.positions.size());
        if (!corner)
            return false;
        if (corners >= 2)
            out.indices.insert(out.indices.end(), {first, before, *corner});
        if (corners == 0)
            first = *corner;
        before = *corner;
    }
    return corners >= 3;
}

} // namespace

base::Result<MeshText> readMeshText(std::string_view text)
{
    MeshText mesh;
    for (size_t line = 1; !text.empty(); ++line) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string_view word = nextWord(rest);
        if (word == "v" && !readVertex(rest, mesh))
            return base::Status(base::Code::Parse,
                                "line " + std::to_string(line) + ": expected three numbers after v");
        if (word == "f" && !readFace(rest, mesh))
            return base::Status(base::Code::Parse, "line " + std::to_string(line) +
                                                       ": expected three or more vertices that were given "
                                                       "before");
    }
    return mesh;
}

} // namespace fx::preset
