#include "fxsdk/presets/json_parser.h"

#include "fxsdk/presets/json_sax.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace fx::preset {

namespace {

using Json = nlohmann::json;

/// Builds the document event by event and stops at the first limit that is exceeded.
class DocumentBuilder final : public nlohmann::json_sax<Json>
{
public:
    DocumentBuilder(std::string_view text, const JsonLimits& limits, Findings& findings)
        : text_(text), limits_(limits), findings_(findings), path_(text)
    {}

    bool run() { return Json::sax_parse(path_.begin(), path_.end(), this); }
    Json& document() { return document_; }

    bool null() override { return scalar(nullptr, 0); }
    bool boolean(bool value) override { return scalar(value, 0); }
    bool number_integer(number_integer_t value) override { return scalar(value, 0); }
    bool number_unsigned(number_unsigned_t value) override { return scalar(value, 0); }
    bool number_float(number_float_t value, const string_t&) override { return scalar(value, 0); }
    bool string(string_t& value) override { return scalar(std::move(value), 32); }
    bool binary(binary_t&) override { return false; } // JSON text has none
    bool start_object(std::size_t) override { return open(Json::object(), false); }
    bool start_array(std::size_t) override { return open(Json::array(), true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override;
    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override;

private:
    /// Puts `value` where the path stands; null when a limit is exceeded.
    Json* add(Json&& value, uint64_t extraBytes);
    bool scalar(Json&& value, uint64_t extraBytes) { return add(std::move(value), extraBytes) != nullptr; }
    bool open(Json&& container, bool isArray);
    bool close();
    bool refuse(const std::string& what, size_t limit);

    std::string_view text_;
    const JsonLimits& limits_;
    Findings& findings_;
    JsonPath path_;
    Json document_;
    std::vector<Json*> open_;
    std::string key_;
    size_t tokenOffset_ = 0;
    size_t nodes_ = 0;
    uint64_t bytes_ = 0;
};

bool DocumentBuilder::refuse(const std::string& what, size_t limit)
{
    findings_.errorAtOffset(path_.pointer(), what + "; at most " + std::to_string(limit) + " are allowed",
                            base::Code::TooLarge, tokenOffset_);
    return false;
}

Json* DocumentBuilder::add(Json&& value, uint64_t extraBytes)
{
    tokenOffset_ = path_.beginToken();
    path_.value();
    const bool isMember = !open_.empty() && open_.back()->is_object();
    bytes_ +=
        (isMember ? 112 + 2 * key_.size() : 48) + extraBytes; // tree node with its name, or vector growth
    if (value.is_string())
        bytes_ += value.get_ref<const std::string&>().size();
    if (++nodes_ > limits_.nodes)
        return refuse("too many values", limits_.nodes), nullptr;
    if (bytes_ > limits_.documentBytes)
        return refuse("too many bytes of memory for the document", limits_.documentBytes), nullptr;
    if (path_.countInside() > limits_.arrayElements)
        return refuse("too many elements in one array or object", limits_.arrayElements), nullptr;

    if (open_.empty()) {
        document_ = std::move(value);
        return &document_;
    }
    if (isMember)
        return &(open_.back()->get_ref<Json::object_t&>()[key_] = std::move(value));
    open_.back()->push_back(std::move(value));
    return &open_.back()->back();
}

bool DocumentBuilder::open(Json&& container, bool isArray)
{
    if (open_.size() >= limits_.depth) {
        tokenOffset_ = path_.beginToken();
        return refuse("too many arrays and objects inside each other", limits_.depth);
    }
    Json* const added = add(std::move(container), 64);
    if (!added)
        return false;
    open_.push_back(added);
    path_.enter(isArray);
    return true;
}

bool DocumentBuilder::close()
{
    path_.beginToken();
    path_.leave();
    open_.pop_back();
    return true;
}

bool DocumentBuilder::key(string_t& name)
{
    const size_t offset = path_.beginToken();
    path_.key(name);
    key_ = name;
    if (open_.back()->contains(name))
        findings_.errorAtOffset(path_.pointer(), "the member \"" + name + "\" occurs twice in one object",
                                base::Code::Schema, offset);
    return !findings_.full();
}

/// The word of letters around text[at], in lower case.
std::string wordAt(std::string_view text, size_t at)
{
    const auto isLetter = [&](size_t i) { return std::isalpha(static_cast<unsigned char>(text[i])) != 0; };
    size_t begin = std::min(at, text.size() - 1);
    while (begin > 0 && isLetter(begin - 1))
        --begin;
    std::string word;
    for (size_t i = begin; i < text.size() && word.size() < 9 && isLetter(i); ++i)
        word += char(std::tolower(static_cast<unsigned char>(text[i])));
    return word;
}

/// Where the token that ends before text[end] begins; `end` where nothing ends there.
/// @param read what the parser has read of it, which is exact for strings
size_t tokenBegin(std::string_view text, size_t end, std::string_view read)
{
    if (end == 0 || end > text.size())
        return end;
    const char last = text[end - 1];
    if (last == '"')
        return end - std::min(end, read.size());
    constexpr std::string_view kOfWords = "0123456789+-.eEabcdfghijklmnopqrstuvwxyz"; // and of numbers
    if (kOfWords.find(last) == std::string_view::npos)
        return std::string_view("[]{},:").find(last) != std::string_view::npos ? end - 1 : end;
    const size_t before = text.find_last_not_of(kOfWords, end - 1);
    return before == std::string_view::npos ? 0 : before + 1;
}

/// A comma or colon that is missing, or a comma too many: what to say and where it belongs.
struct SeparatorFault
{
    std::string message;
    size_t offset;
};

/// The separator at fault when the token that begins at text[begin] must not follow the one before it. A
/// parser learns of a missing separator from the next token, which may be lines below the place of the
/// separator.
std::optional<SeparatorFault> separatorFault(std::string_view text, size_t begin, bool wantsColon)
{
    const size_t before = begin == 0 ? std::string_view::npos : text.find_last_not_of(" \t\r\n", begin - 1);
    if (before == std::string_view::npos || begin >= text.size())
        return std::nullopt;
    const auto isOneOf = [](char c, std::string_view set) { return set.find(c) != std::string_view::npos; };
    if (isOneOf(text[begin], "]}"))
        return text[before] == ',' ? std::optional(SeparatorFault{"no value follows this comma", before})
                                   : std::nullopt;
    if (isOneOf(text[begin], ",:") || isOneOf(text[before], ",:[{"))
        return std::nullopt;
    return SeparatorFault{
        wantsColon ? "a colon is missing after this name" : "a comma is missing after this value", before};
}

bool DocumentBuilder::parse_error(std::size_t position, const std::string& token,
                                  const nlohmann::detail::exception& error)
{
    size_t offset = position > text_.size() ? text_.size() : position - std::min<size_t>(position, 1);
    std::string message =
        error.what(); // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    for (const std::string_view mark : {"syntax error", "number overflow"})
        if (const size_t at = message.find(mark); at != std::string::npos)
            message.erase(0, at);
    if (text_.empty())
        message = "the file is empty";
    else if (const std::string word = wordAt(text_, offset);
             word == "nan" || word == "inf" || word == "infinity")
        message += "; NaN and Infinity are not numbers in JSON";
    else if (message.find("unexpected ") != std::string::npos && path_.depth() > 0)
        if (auto fault =
                separatorFault(text_, tokenBegin(text_, position, token), message.ends_with("expected ':'")))
        {
            message = std::move(fault->message);
            offset = fault->offset;
        }
    findings_.errorAtOffset(path_.pointer(), "not valid JSON: " + message, base::Code::Parse, offset);
    return false;
}

/// Refuses texts with a string, number or word that is longer than a limit, before the parser would hold it
/// in memory.
bool checkTokens(std::string_view text, size_t limit, Findings& findings)
{
    bool inString = false;
    size_t start = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool isSeparator = c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == ',' || c == ':' ||
                                 c == '[' || c == ']' || c == '{' || c == '}';
        if (inString && c == '\\')
            ++i;
        else if (c == '"') {
            inString = !inString;
            start = i + 1;
        } else if (!inString && isSeparator)
            start = i + 1;
        if (i + 1 > start + limit) {
            findings.errorAtOffset(
                "", "a string, name or number has more than " + std::to_string(limit) + " bytes",
                base::Code::TooLarge, start);
            return false;
        }
    }
    return true;
}

} // namespace

std::optional<nlohmann::json> parseJson(std::string_view text, const JsonLimits& limits, Findings& findings)
{
    if (text.size() > limits.bytes) {
        findings.errorAtOffset("",
                               "the text has " + std::to_string(text.size()) + " bytes; at most " +
                                   std::to_string(limits.bytes) + " are allowed",
                               base::Code::TooLarge, 0);
        return std::nullopt;
    }
    if (!checkTokens(text, limits.tokenBytes, findings))
        return std::nullopt;
    DocumentBuilder builder(text, limits, findings);
    if (!builder.run() || findings.hasErrors())
        return std::nullopt;
    return std::move(builder.document());
}

} // namespace fx::preset
