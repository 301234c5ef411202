#include "fxsdk/assets/asset_resolver.h"

#include "foundation/result/nearest_name.h"
#include "fxsdk/assets/read_file.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace fx::asset {

namespace {

constexpr std::string_view kLibraryPrefix = "library:";
constexpr std::string_view kPresetSuffix = ".fx.json";
constexpr size_t kLongestName = 512;

base::Status refused(std::string_view name, const char* why)
{
    return {base::Code::InvalidArgument, "asset \"" + std::string(name.substr(0, 64)) + "\": " + why};
}

bool hasForbiddenCharacter(std::string_view name)
{
    return std::any_of(name.begin(), name.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':' || c == 0x7F;
    });
}

bool hasParentPart(std::string_view name)
{
    for (size_t begin = 0; begin <= name.size();) {
        const size_t end = std::min(name.find('/', begin), name.size());
        if (name.substr(begin, end - begin) == "..")
            return true;
        begin = end + 1;
    }
    return false;
}

/// True when `file`, with every link followed, lies below `folder`.
bool liesBelow(const std::filesystem::path& folder, const std::filesystem::path& file)
{
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    static_cast<void>(rest);
    return end == folder.end();
}

base::Status tooLarge(std::string_view name, uint64_t maxBytes)
{
    return {base::Code::TooLarge, "asset \"" + std::string(name) + "\" has more than the allowed " +
                                      std::to_string(maxBytes) + " bytes"};
}

} // namespace

base::Status checkAssetName(std::string_view name)
{
    const bool inLibrary = name.starts_with(kLibraryPrefix);
    const std::string_view rest = inLibrary ? name.substr(kLibraryPrefix.size()) : name;
    if (rest.empty())
        return refused(name, "the name is empty");
    if (name.size() > kLongestName)
        return refused(name, "the name has more than 512 bytes");
    if (rest.front() == '/')
        return refused(name, "an absolute path; name assets relative to the file's folder, or library:NAME");
    if (hasParentPart(rest))
        return refused(name, "\"..\" leads out of the file's folder");
    if (hasForbiddenCharacter(rest))
        return refused(name, "backslash, colon and control characters are not allowed");
    return {};
}

base::Result<std::string> AssetResolver::read(std::string_view name, uint64_t maxBytes) const
{
    if (base::Status status = checkAssetName(name); !status)
        return status;
    if (name.starts_with(kLibraryPrefix))
        return readLibrary(name, maxBytes);
    if (hook_.read) {
        base::Result<std::string> bytes = readHook(std::string(name), maxBytes);
        if (bytes || bytes.status().code() != base::Code::NotFound)
            return bytes;
    }
    const base::Result<std::string> file = find(std::string(name));
    return file ? asset::readFile(*file, maxBytes) : file.status();
}

std::string AssetResolver::fileOf(std::string_view name) const
{
    if (hook_.read || name.starts_with(kLibraryPrefix) || !checkAssetName(name))
        return {};
    const base::Result<std::string> file = find(std::string(name));
    return file ? *file : std::string();
}

base::Result<std::string> AssetResolver::readLibrary(std::string_view name, uint64_t maxBytes) const
{
    std::string file(name.substr(kLibraryPrefix.size()));
    if (file.find('.') == std::string::npos)
        file += kPresetSuffix;
    const bool isPreset = file.ends_with(kPresetSuffix);
    const auto shown = [&](std::string_view found) {
        return std::string(found.substr(0, found.size() - (isPreset ? kPresetSuffix.size() : 0)));
    };
    std::vector<std::string> known; // of the same kind
    for (const base::EmbeddedText& entry : library_) {
        if (entry.name == file)
            return entry.text.size() <= maxBytes ? base::Result<std::string>(std::string(entry.text))
                                                 : tooLarge(name, maxBytes);
        if (entry.name.ends_with(kPresetSuffix) == isPreset)
            known.push_back(shown(entry.name));
    }
    std::string message = "asset \"" + std::string(name) + "\" is not in the library; it holds:";
    for (const std::string& candidate : known)
        message += " " + candidate;
    return base::Status(base::Code::NotFound, message + base::didYouMean(shown(file), known));
}

base::Result<std::string> AssetResolver::readHook(const std::string& name, uint64_t maxBytes) const
{
    std::string bytes;
    const auto deliver = [](void* sink, const void* data, size_t size) {
        static_cast<std::string*>(sink)->assign(static_cast<const char*>(data), size);
    };
    const int outcome = hook_.read(hook_.user, name.c_str(), maxBytes, deliver, &bytes);
    if (outcome == 2 || bytes.size() > maxBytes)
        return tooLarge(name, maxBytes);
    if (outcome == 1)
        return base::Status(base::Code::NotFound, "asset \"" + name + "\" does not exist");
    if (outcome != 0)
        return base::Status(base::Code::Io, "asset \"" + name + "\": the host could not read it");
    return bytes;
}

/// Where a relative name leads to.
base::Result<std::string> AssetResolver::find(const std::string& name) const
{
    if (folder_.empty())
        return base::Status(base::Code::NotFound,
                            "asset \"" + name +
                                "\" does not exist: there is no folder to look in; load "
                                "the preset from a file, or name library:NAME");
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::canonical(folder_, error);
    if (error)
        return base::Status(base::Code::NotFound, folder_ + ": no such folder");
    const std::filesystem::path file = std::filesystem::canonical(folder / name, error);
    if (error)
        return base::Status(base::Code::NotFound,
                            "asset \"" + name + "\" does not exist in " + folder.string());
    if (!liesBelow(folder, file))
        return refused(name, "a symbolic link leads out of the file's folder");
    return file.string();
}

} // namespace fx::asset
