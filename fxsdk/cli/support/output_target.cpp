#include "fxsdk/cli/support/output_target.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <utility>

namespace fx::cli {
namespace {

base::Status refused(const std::string& text, const std::string& reason)
{
    return {base::Code::InvalidArgument, "output '" + text + "': " + reason};
}

} // namespace

std::filesystem::path NumberedFile::frame(int64_t number) const
{
    if (!isSequence())
        return path;
    std::string count = std::to_string(number);
    if (count.size() < size_t(digits))
        count.insert(0, size_t(digits) - count.size(), '0');
    return path.parent_path() / path.filename().string().replace(numberAt, numberLength, count);
}

std::string suffixOf(const std::filesystem::path& path)
{
    std::string suffix = path.extension().string();
    for (char& letter : suffix)
        letter = char(std::tolower(static_cast<unsigned char>(letter)));
    return suffix;
}

base::Result<NumberedFile> parseNumberedFile(const std::string& text)
{
    NumberedFile file;
    file.path = text;
    if (file.path.parent_path().string().find('%') != std::string::npos)
        return refused(text, "the frame number belongs into the file name, not into a folder");
    const std::string name = file.path.filename().string();
    static const std::regex kNumber("%0?([0-9]?)d");
    std::smatch match;
    if (std::regex_search(name, match, kNumber)) {
        file.numberAt = size_t(match.position(0));
        file.numberLength = size_t(match.length(0));
        file.digits = match.length(1) > 0 ? match[1].str()[0] - '0' : 1;
    }
    const size_t percents = size_t(std::count(name.begin(), name.end(), '%'));
    if (percents != (file.isSequence() ? 1u : 0u))
        return refused(text, "exactly one place holder such as %04d may be used");
    return file;
}

base::Result<OutputTarget> parseOutputTarget(const std::string& text)
{
    OutputTarget target;
    const std::string suffix = suffixOf(text);
    if (suffix == ".png")
        target.kind = OutputKind::Png;
    else if (suffix == ".exr")
        target.kind = OutputKind::Exr;
    else if (suffix == ".mp4")
        target.kind = OutputKind::Mp4;
    else
        return refused(text, "the name must end in .png, .exr or .mp4");
    auto file = parseNumberedFile(text);
    if (!file.ok())
        return file.status();
    static_cast<NumberedFile&>(target) = std::move(*file);
    if (target.isSequence() && target.kind == OutputKind::Mp4)
        return refused(text, "a video is one file and takes no place holder");
    return target;
}

} // namespace fx::cli
