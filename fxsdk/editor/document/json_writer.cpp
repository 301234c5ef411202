#include "fxsdk/editor/document/json_writer.h"

#include <algorithm>

namespace fx::editor {

namespace {

constexpr size_t kIndent = 2; // blanks per level

/// A value of the earlier text.
struct Earlier
{
    const Json* value;
    const TextSpan* span;
};

std::string quoted(const std::string& text)
{
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The shortest text that gives the same number; whole numbers have no ".0".
std::string scalar(const Json& value)
{
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (value.is_number_float() && text.ends_with(".0"))
        text.resize(text.size() - 2);
    return text;
}

std::string oneLine(const Json& value)
{
    if (!value.is_structured())
        return scalar(value);
    std::string text(1, value.is_object() ? '{' : '[');
    bool isFirst = true;
    for (auto it = value.begin(); it != value.end(); ++it) {
        text += isFirst ? "" : ", ";
        isFirst = false;
        if (value.is_object())
            text.append(quoted(it.key())).append(": ");
        text += oneLine(*it);
    }
    return text + (value.is_object() ? '}' : ']');
}

class Writer
{
public:
    explicit Writer(std::string_view beforeText) : before_(beforeText) {}

    void value(const Json& value, const Earlier* earlier, size_t indent)
    {
        if (earlier && *earlier->value == value)
            out_ += textOf(*earlier->span);
        else if (earlier && hasSameShape(value, *earlier->value))
            patch(value, *earlier, indent);
        else
            lay(value, earlier, indent);
    }

    std::string take() { return std::move(out_); }

private:
    std::string_view textOf(const TextSpan& span) const
    {
        return before_.substr(span.begin, span.end - span.begin);
    }

    size_t column() const
    {
        const size_t lineFeed = out_.find_last_of('\n');
        return lineFeed == std::string::npos ? out_.size() : out_.size() - lineFeed - 1;
    }

    static bool hasSameShape(const Json& a, const Json& b)
    {
        if (a.type() != b.type() || !a.is_structured() || a.size() != b.size() || a.empty())
            return false;
        if (a.is_array())
            return true;
        for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j)
            if (i.key() != j.key())
                return false;
        return true;
    }

    /// Writes the earlier text with the children that differ replaced.
    void patch(const Json& value, const Earlier& earlier, size_t indent)
    {
        size_t at = earlier.span->begin;
        const bool isBroken = textOf(*earlier.span).find('\n') != std::string_view::npos;
        auto child = value.begin();
        auto old = earlier.value->begin();
        for (const TextSpan& span : earlier.span->children) {
            out_ += before_.substr(at, span.begin - at);
            const Earlier inner{&*old, &span};
            this->value(*child, &inner, isBroken ? indent + kIndent : indent);
            at = span.end;
            ++child;
            ++old;
        }
        out_ += before_.substr(at, earlier.span->end - at);
    }

    /// The earlier value of a member or element of `earlier`; nothing when there was none.
    static bool findEarlier(const Json& container, const Json& value, const std::string& key,
                            const Earlier* earlier, Earlier& out)
    {
        if (!earlier || earlier->value->type() != container.type())
            return false;
        size_t index = 0;
        for (auto it = earlier->value->begin(); it != earlier->value->end(); ++it, ++index)
            if (container.is_object() ? it.key() == key : *it == value) {
                out = {&*it, &earlier->span->children[index]};
                return true;
            }
        return false;
    }

    /// Writes a value in a layout of its own. Its members keep their earlier text where they have one.
    void lay(const Json& value, const Earlier* earlier, size_t indent)
    {
        const bool wasBroken = earlier && earlier->value->is_structured() &&
                               textOf(*earlier->span).find('\n') != std::string_view::npos;
        const bool isShort = column() + oneLine(value).size() <= kLineColumns;
        const bool isRoot = indent == 0 && out_.empty();
        if (!value.is_structured() || value.empty() || (isShort && !wasBroken && !isRoot)) {
            out_ += oneLine(value);
            return;
        }
        out_ += value.is_object() ? '{' : '[';
        bool isFirst = true;
        for (auto it = value.begin(); it != value.end(); ++it) {
            out_ += isFirst ? "\n" : ",\n";
            isFirst = false;
            out_.append(indent + kIndent, ' ');
            const std::string key = value.is_object() ? it.key() : std::string();
            if (value.is_object())
                out_.append(quoted(key)).append(": ");
            Earlier inner{};
            const bool hasEarlier = findEarlier(value, *it, key, earlier, inner);
            this->value(*it, hasEarlier ? &inner : nullptr, indent + kIndent);
        }
        out_.append("\n").append(indent, ' ');
        out_ += value.is_object() ? '}' : ']';
    }

    std::string_view before_;
    std::string out_;
};

} // namespace

std::string writeJson(const Json& document)
{
    Writer writer({});
    writer.value(document, nullptr, 0);
    return writer.take() + "\n";
}

std::string writeJson(const Json& document, const Json& before, std::string_view beforeText)
{
    if (document == before)
        return std::string(beforeText);
    const TextSpan spans = textSpans(beforeText);
    const Earlier earlier{&before, &spans};
    Writer writer(beforeText);
    writer.value(document, &earlier, 0);
    return writer.take() + std::string(beforeText.substr(std::min(spans.end, beforeText.size())));
}

} // namespace fx::editor
