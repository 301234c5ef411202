#include "fxsdk/editor/document/text_spans.h"

namespace fx::editor {

namespace {

class Scanner
{
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    TextSpan value()
    {
        skipBlanks();
        TextSpan span{at_, at_, {}};
        if (peek() == '{' || peek() == '[')
            container(span);
        else if (peek() == '"')
            string();
        else
            while (at_ < text_.size() &&
                   std::string_view(" \t\r\n,]}").find(peek()) == std::string_view::npos)
                ++at_;
        span.end = at_;
        return span;
    }

private:
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void skipBlanks()
    {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(peek()) != std::string_view::npos)
            ++at_;
    }

    void string()
    {
        for (++at_; at_ < text_.size() && peek() != '"'; ++at_)
            if (peek() == '\\')
                ++at_;
        ++at_;
    }

    void container(TextSpan& io)
    {
        const bool isObject = peek() == '{';
        ++at_;
        for (skipBlanks(); at_ < text_.size() && peek() != '}' && peek() != ']'; skipBlanks()) {
            if (isObject) {
                string();
                skipBlanks();
                ++at_; // the colon
            }
            io.children.push_back(value());
            skipBlanks();
            if (peek() == ',')
                ++at_;
        }
        ++at_;
    }

    std::string_view text_;
    size_t at_ = 0;
};

} // namespace

TextSpan textSpans(std::string_view text)
{
    return Scanner(text).value();
}

} // namespace fx::editor
