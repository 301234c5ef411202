/// @file json_sax.h
/// Common base of the two readers of JSON text: text position and JSON pointer of a SAX event. Only files of
/// fxsdk/presets include this header.
#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace fx::preset {

/// Iterator over the text of a JSON document. All copies of an iterator share the furthest position of any
/// copy. A handler of SAX events reads this position to find how far the parser has read.
class TrackedIterator
{
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    TrackedIterator(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
    reference operator*() const { return *at_; }
    TrackedIterator& operator++()
    {
        *furthest_ = ++at_;
        return *this;
    }
    TrackedIterator operator++(int)
    {
        TrackedIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const TrackedIterator& other) const { return at_ == other.at_; }
    bool operator!=(const TrackedIterator& other) const { return at_ != other.at_; }

private:
    const char* at_;
    const char** furthest_;
};

/// Tracks a stream of SAX events: the JSON pointer of the current value and the offset of the current token.
class JsonPath
{
public:
    explicit JsonPath(std::string_view text) : text_(text), furthest_(text.data()) {}

    TrackedIterator begin() { return {text_.data(), &furthest_}; }
    TrackedIterator end() { return {text_.data() + text_.size(), &furthest_}; }

    /// Finds the token of the present event. Every event must call this function first. @return offset at
    /// which the token begins
    size_t beginToken();
    void key(const std::string& name);
    /// Begins a value and counts it within its array.
    void value();
    void enter(bool isArray);
    void leave();

    size_t depth() const { return levels_.size(); }
    bool insideArray() const { return !levels_.empty() && levels_.back().isArray; }
    size_t countInside() const { return levels_.empty() ? 0 : levels_.back().count; }
    /// JSON pointer of the value of the last call of value(), or of the member of the last call of key().
    std::string pointer() const;

private:
    struct Level
    {
        bool isArray;
        size_t count;        ///< number of values of this array or object that have begun
        size_t parentLength; ///< length of the JSON pointer of the enclosing level
    };

    std::string_view text_;
    const char* furthest_;
    size_t lastEnd_ = 0;
    std::vector<Level> levels_;
    std::string container_; ///< JSON pointer of the innermost array or object
    std::string key_;       ///< name of the current member, escaped
};

/// `name` with '~' and '/' escaped as in JSON pointers.
std::string escapePointer(std::string_view name);

} // namespace fx::preset
