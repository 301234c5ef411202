/// @file gallery_command.cpp
/// fx gallery: a page with a picture, a strip of moments and the costs of each preset.

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/gallery/gallery_page.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/frame_range.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"
#include "fxsdk/presets/preset_loader.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr int kSmallestSide = 16;  // [pixel]
constexpr int kLargestSide = 2048; // [pixel]; pictures stay in memory until all of them are drawn
constexpr int kMostTimes = 8;
constexpr size_t kMostPresets = 256;
constexpr std::string_view kSuffix = ".fx.json";
constexpr std::string_view kLibrary = "library:";

struct GalleryArguments
{
    std::vector<std::string> names;
    std::string folder;
    std::string size = "480x270";
    int times = 4;
    bool json = false;
};

int failed(const base::Status& status, int code)
{
    std::fprintf(stderr, "fx gallery: %s\n", status.message().c_str());
    return code;
}

/// library:NAME for the names of the library, with and without "library:"; paths as they are.
std::vector<std::string> inputsOf(const GalleryArguments& arguments)
{
    std::vector<std::string> inputs;
    for (const std::string& name : arguments.names)
        inputs.push_back(
            name.ends_with(kSuffix) || name.starts_with(kLibrary) ? name : std::string(kLibrary) + name);
    if (arguments.names.empty())
        for (const base::EmbeddedText& text : preset::presetLibrary())
            if (text.name.ends_with(kSuffix))
                inputs.push_back(std::string(kLibrary) +
                                 std::string(text.name.substr(0, text.name.size() - kSuffix.size())));
    return inputs;
}

/// The last part of a name, of characters that all file systems take, and different from those in `ioTaken`.
std::string fileNameFor(const std::string& input, std::set<std::string>& ioTaken)
{
    std::string name = input.starts_with(kLibrary) ? input.substr(kLibrary.size())
                                                   : std::filesystem::path(input).filename().string();
    if (name.ends_with(kSuffix))
        name.resize(name.size() - kSuffix.size());
    for (char& c : name)
        if (!(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9') && c != '-' &&
            c != '_')
            c = '-';
    if (name.empty())
        name = "preset";
    std::string unique = name;
    for (int number = 2; !ioTaken.insert(unique).second; ++number)
        unique = name + "-" + std::to_string(number);
    return unique;
}

base::Result<GalleryOptions> optionsOf(const GalleryArguments& arguments)
{
    GalleryOptions options;
    const auto size = parsePair(arguments.size, 'x');
    const auto isSide = [](int64_t side) { return side >= kSmallestSide && side <= kLargestSide; };
    if (!size || !isSide(size->first) || !isSide(size->second))
        return base::Status(base::Code::InvalidArgument,
                            "--size " + arguments.size + ": expected WIDTHxHEIGHT, each from " +
                                std::to_string(kSmallestSide) + " to " + std::to_string(kLargestSide));
    options.width = int(size->first);
    options.height = int(size->second);
    options.times = arguments.times;
    return options;
}

/// Before a long computation.
base::Status checkFolder(const std::filesystem::path& folder)
{
    std::error_code error;
    if (std::filesystem::is_directory(folder, error))
        return {};
    if (std::filesystem::exists(folder, error))
        return {base::Code::Io,
                "cannot write to " + folder.string() + ": it is a file; give a folder with -o"};
    const std::filesystem::path above = folder.has_parent_path() ? folder.parent_path() : ".";
    if (std::filesystem::is_directory(above, error))
        return {};
    return {base::Code::Io, "cannot create " + folder.string() + ": there is no folder " + above.string() +
                                "; create it first"};
}

/// Draws all presets before it writes a file, so that nothing is written of a run that fails or is
/// interrupted.
class Gallery
{
public:
    Gallery(const GalleryArguments& arguments, const GalleryOptions& options)
        : arguments_(arguments), options_(options)
    {
        folder_ = arguments.folder;
        if (!folder_.has_filename()) // DIR/
            folder_ = folder_.parent_path();
    }

    base::Status run()
    {
        if (base::Status status = checkFolder(folder_); !status)
            return status;
        const std::vector<std::string> inputs = inputsOf(arguments_);
        for (const std::string& input : inputs) // before the first is drawn
            if (const auto scene = sceneOfPreset(input); !scene.ok())
                return scene.status();
        std::set<std::string> taken;
        Progress progress("picture", inputs.size() * size_t(picturesOf(options_)), !arguments_.json);
        uint64_t done = 0;
        progress.update(done);
        for (const std::string& input : inputs) {
            auto entry = makeGalleryEntry(input, options_, [&] { progress.update(++done); });
            if (!entry.ok())
                return entry.status().code() == base::Code::Interrupted
                           ? entry.status()
                           : base::Status(entry.status().code(), input + ": " + entry.status().message());
            entry->name = fileNameFor(input, taken);
            machine_.glRenderer = entry->renderer;
            entries_.push_back(std::move(*entry));
        }
        return write();
    }

    void report() const
    {
        if (!arguments_.json) {
            std::printf("%s: %zu %s of %dx%d on %s\n", (folder_ / "index.html").c_str(), entries_.size(),
                        entries_.size() == 1 ? "preset" : "presets", options_.width, options_.height,
                        toText(machine_).c_str());
            return;
        }
        for (const GalleryEntry& entry : entries_) {
            nlohmann::json line = {{"preset", entry.input},
                                   {"picture", (folder_ / pictureName(entry)).string()},
                                   {"strip", nullptr},
                                   {"page", (folder_ / "index.html").string()},
                                   {"time", entry.time},
                                   {"times", entry.times},
                                   {"particles", entry.particles},
                                   {"bytes", entry.memory},
                                   {"bytes_textures", entry.textures},
                                   {"ms_frame", entry.frameMilliseconds},
                                   {"ms_update", entry.updateMilliseconds},
                                   {"frames_measured", entry.measured}};
            if (!entry.strip.empty())
                line["strip"] = (folder_ / stripName(entry)).string();
            printJsonLine(withMachine(line, machine_));
        }
    }

private:
    /// The page comes last, when all that it shows is there.
    base::Status write()
    {
        std::error_code error;
        const bool isNew = std::filesystem::create_directory(folder_, error);
        if (error)
            return {base::Code::Io, "cannot create " + folder_.string() + ": " + error.message()};
        base::Status status;
        const auto add = [&](const std::string& name, const std::string& bytes) {
            if (!status.ok() || bytes.empty())
                return;
            const bool isThere = std::filesystem::exists(folder_ / name, error);
            status = writeFileAtomically(folder_ / name, bytes);
            if (status.ok() && !isThere)
                written_.push_back(folder_ / name);
        };
        for (const GalleryEntry& entry : entries_) {
            add(pictureName(entry), entry.picture);
            add(stripName(entry), entry.strip);
            if (status.ok() && interruptRequested())
                status = interruptedStatus();
        }
        add("index.html", galleryPage(entries_, options_, machine_));
        if (status.ok())
            return {};
        for (const std::filesystem::path& file : written_)
            std::filesystem::remove(file, error);
        if (isNew)
            std::filesystem::remove(folder_, error); // it is empty
        return status;
    }

    const GalleryArguments& arguments_;
    const GalleryOptions& options_;
    std::filesystem::path folder_;
    Machine machine_ = readMachine();
    std::vector<GalleryEntry> entries_;
    std::vector<std::filesystem::path> written_; ///< files that were not there before
};

int runGallery(const GalleryArguments& arguments)
{
    const auto options = optionsOf(arguments);
    if (!options.ok())
        return failed(options.status(), kUsage);
    if (arguments.names.size() > kMostPresets)
        return failed({base::Code::InvalidArgument, "found " + std::to_string(arguments.names.size()) +
                                                        " presets; at most " + std::to_string(kMostPresets) +
                                                        " fit on a page"},
                      kUsage);
    Gallery gallery(arguments, *options);
    if (const base::Status status = gallery.run(); !status)
        return failed(status, exitCodeOf(status));
    gallery.report();
    return kSuccess;
}

} // namespace

void addGalleryCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<GalleryArguments>();
    CLI::App* command = app.add_subcommand(
        "gallery", "Write a page with pictures, strips of moments and measured costs of presets");
    command->add_option(
        "NAME", arguments->names,
        "Presets of the library (campfire or library:campfire) or *.fx.json (default: the whole "
        "library)");
    command
        ->add_option("-o,--output", arguments->folder,
                     "Folder of index.html and the pictures; made if need be")
        ->required();
    command->add_option("--size", arguments->size, "Size of a picture in pixels, WIDTHxHEIGHT")
        ->capture_default_str();
    command->add_option("--times", arguments->times, "Moments of the strip below each picture; 0: no strip")
        ->check(CLI::Range(0, kMostTimes))
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "One object for each preset");
    command->callback([arguments, &outExitCode] { outExitCode = runGallery(*arguments); });
}

} // namespace fx::cli
