#include "fxsdk/presets/json_sax.h"

namespace fx::preset {

size_t JsonPath::beginToken()
{
    // Between the last token and this one there are only white space, commas, colons and a byte order mark. A
    // number ends one character after its last digit, and that is one of these too.
    const size_t start = text_.find_first_not_of(" \t\r\n,:\xEF\xBB\xBF", lastEnd_);
    lastEnd_ = size_t(furthest_ - text_.data());
    return start < text_.size() ? start : text_.size();
}

void JsonPath::key(const std::string& name)
{
    key_ = escapePointer(name);
}

void JsonPath::value()
{
    if (!levels_.empty())
        ++levels_.back().count;
}

void JsonPath::enter(bool isArray)
{
    const size_t parentLength = container_.size();
    container_ = pointer();
    levels_.push_back({isArray, 0, parentLength});
}

void JsonPath::leave()
{
    container_.resize(levels_.back().parentLength);
    levels_.pop_back();
}

std::string JsonPath::pointer() const
{
    if (levels_.empty())
        return {};
    const Level& level = levels_.back();
    if (!level.isArray)
        return container_ + "/" + key_;
    return container_ + "/" + std::to_string(level.count > 0 ? level.count - 1 : 0);
}

std::string escapePointer(std::string_view name)
{
    std::string escaped;
    for (const char c : name) {
        if (c == '~')
            escaped += "~0";
        else if (c == '/')
            escaped += "~1";
        else
            escaped += c;
    }
    return escaped;
}

} // namespace fx::preset
