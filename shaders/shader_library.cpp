#include "shaders/shader_library.h"

#include <algorithm>
#include <vector>

namespace fx::shaders {

namespace {

constexpr std::string_view kPrologue = "#version 450 core\n"
                                       "#define FX_REAL float\n"
                                       "#define FX_FORMULA(name) float name\n";

const base::EmbeddedText* find(std::string_view name)
{
    for (const std::span<const base::EmbeddedText> texts : folders()) {
        const auto it =
            std::find_if(texts.begin(), texts.end(), [&](const auto& text) { return text.name == name; });
        if (it != texts.end())
            return &*it;
    }
    return nullptr;
}

/// The quoted path of an include line, or nothing.
std::optional<std::string_view> includedPath(std::string_view line)
{
    constexpr std::string_view kInclude = "#include \"";
    if (!line.starts_with(kInclude))
        return {};
    const size_t end = line.find('"', kInclude.size());
    if (end == std::string_view::npos)
        return {};
    return line.substr(kInclude.size(), end - kInclude.size());
}

bool expand(std::string_view name, std::vector<std::string_view>& seen, std::string& out)
{
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
        return true;
    seen.push_back(name);
    const base::EmbeddedText* text = find(name);
    if (!text)
        return false;
    for (std::string_view rest = text->text; !rest.empty();) {
        const size_t end = std::min(rest.find('\n'), rest.size() - 1);
        const std::string_view line = rest.substr(0, end + 1);
        rest.remove_prefix(end + 1);
        if (const auto path = includedPath(line)) {
            if (!expand(*path, seen, out))
                return false;
        } else {
            out.append(line);
        }
    }
    return true;
}

void appendDefines(std::string_view defines, std::string& out)
{
    while (true) {
        const size_t begin = defines.find_first_not_of(" \n");
        if (begin == std::string_view::npos)
            return;
        defines.remove_prefix(begin);
        const size_t end = std::min(defines.find_first_of(" \n"), defines.size());
        const std::string_view define = defines.substr(0, end);
        defines.remove_prefix(end);
        const size_t equals = define.find('=');
        out.append("#define ").append(define.substr(0, equals));
        if (equals != std::string_view::npos)
            out.append(" ").append(define.substr(equals + 1));
        out.append("\n");
    }
}

} // namespace

std::optional<std::string> assemble(std::string_view name, std::string_view defines)
{
    std::string out(kPrologue);
    appendDefines(defines, out);
    std::vector<std::string_view> seen;
    if (!expand(name, seen, out))
        return {};
    return out;
}

std::string_view text(std::string_view name)
{
    const base::EmbeddedText* const found = find(name);
    return found ? found->text : std::string_view();
}

} // namespace fx::shaders
