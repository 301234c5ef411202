/// @file findings.h
/// Collects findings about a parsed document by JSON pointer. Lines and columns are added at the end.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/presets/diagnostic.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fx::asset {
class AssetLoader;
}

namespace fx::preset {

constexpr size_t kUnknownOffset = ~size_t(0);

/// One finding, located by JSON pointer or by offset in the text.
struct Finding
{
    std::string pointer;
    std::string message;
    base::Code code = base::Code::Schema;
    bool atKey = false; ///< true: the finding is located at the name of the member, not at its value
    bool warning = false;
    size_t offset = kUnknownOffset; ///< [byte] position in the text, when known
};

/// Maps a JSON pointer of the migrated document to a JSON pointer of the original text.
struct Renaming
{
    std::string now;
    std::string before;
};

class Findings
{
public:
    /// Creates an empty collection of findings.
    /// @param assets loader of the files that the document names; null: the document names no files
    explicit Findings(asset::AssetLoader* assets = nullptr) : assets_(assets) {}
    asset::AssetLoader* assets() const { return assets_; }

    void error(std::string pointer, std::string message, base::Code code = base::Code::Schema);
    void errorAtKey(std::string pointer, std::string message);
    void errorAtOffset(std::string pointer, std::string message, base::Code code, size_t offset);
    void warning(std::string pointer, std::string message);
    void renamed(std::string now, std::string before)
    {
        renamings_.push_back({std::move(now), std::move(before)});
    }

    bool full() const { return list_.size() >= kLimit; } ///< whether further findings are dropped
    bool hasErrors() const { return firstCode_ != base::Code::Ok; }
    base::Code firstCode() const { return firstCode_; } ///< code of the first error; Ok without errors
    size_t size() const { return list_.size(); }

    /// The findings with their positions in `text`, in the order of the text.
    std::vector<Diagnostic> locate(std::string_view text, const std::string& file) const;

    static constexpr size_t kLimit = 100; ///< maximum number of findings; further findings are dropped

private:
    void add(Finding finding);

    asset::AssetLoader* assets_;
    std::vector<Finding> list_;
    std::vector<Renaming> renamings_;
    base::Code firstCode_ = base::Code::Ok;
};

} // namespace fx::preset
