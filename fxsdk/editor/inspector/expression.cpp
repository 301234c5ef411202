#include "fxsdk/editor/inspector/expression.h"

#include "fxsdk/editor/inspector/units.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

namespace fx::editor {

namespace {

constexpr int kMaxDepth = 64; // nested parentheses, signs and powers

using Function = double (*)(double, double);

struct NamedFunction
{
    std::string_view name;
    int arguments;
    Function call;
};

constexpr auto kFunctions = std::to_array<NamedFunction>({
    {"sqrt", 1, [](double a, double) { return std::sqrt(a); }},
    {"abs", 1, [](double a, double) { return std::abs(a); }},
    {"sin", 1, [](double a, double) { return std::sin(a); }},
    {"cos", 1, [](double a, double) { return std::cos(a); }},
    {"tan", 1, [](double a, double) { return std::tan(a); }},
    {"exp", 1, [](double a, double) { return std::exp(a); }},
    {"log", 1, [](double a, double) { return std::log(a); }},
    {"min", 2, [](double a, double b) { return std::fmin(a, b); }},
    {"max", 2, [](double a, double b) { return std::fmax(a, b); }},
});

class Parser
{
public:
    Parser(std::string_view text, std::string_view unit) : text_(text), unit_(unit) {}

    base::Result<double> run()
    {
        const double result = sum();
        skipBlanks();
        if (message_.empty() && at_ < text_.size())
            fail("this is not expected");
        if (message_.empty() && !std::isfinite(result))
            fail("the result is not a finite number");
        if (!message_.empty())
            return base::Status(base::Code::InvalidArgument, "\"" + std::string(text_) + "\", character " +
                                                                 std::to_string(place_ + 1) + ": " +
                                                                 message_);
        return result;
    }

private:
    void fail(const std::string& message)
    {
        if (!message_.empty())
            return;
        message_ = message;
        place_ = at_;
    }

    void skipBlanks()
    {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
            ++at_;
    }

    bool take(char wanted)
    {
        skipBlanks();
        if (at_ >= text_.size() || text_[at_] != wanted)
            return false;
        ++at_;
        return true;
    }

    double sum()
    {
        double value = product();
        while (message_.empty())
            if (take('+'))
                value += product();
            else if (take('-'))
                value -= product();
            else
                break;
        return value;
    }

    double product()
    {
        double value = signedPower();
        while (message_.empty())
            if (take('*'))
                value *= signedPower();
            else if (take('/'))
                value /= signedPower();
            else
                break;
        return value;
    }

    double signedPower()
    {
        if (++depth_ > kMaxDepth)
            fail("the expression is nested too deeply");
        double value = 0.0;
        if (!message_.empty())
            value = 0.0;
        else if (take('-'))
            value = -signedPower();
        else if (take('+'))
            value = signedPower();
        else {
            value = withUnit(operand());
            if (message_.empty() && take('^'))
                value = std::pow(value, signedPower());
        }
        --depth_;
        return value;
    }

    double operand()
    {
        skipBlanks();
        if (take('(')) {
            const double value = sum();
            if (!take(')'))
                fail("a parenthesis is not closed");
            return value;
        }
        if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])))
            return named();
        double value = 0.0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error != std::errc())
            fail(at_ < text_.size() ? "a number is expected here" : "a number is missing at the end");
        else
            at_ += size_t(end - begin);
        return value;
    }

    double named()
    {
        const std::string_view name = letters();
        if (name == "pi")
            return std::numbers::pi;
        if (name == "e")
            return std::numbers::e;
        for (const NamedFunction& function : kFunctions)
            if (function.name == name)
                return call(function);
        at_ -= name.size();
        fail("\"" + std::string(name) +
             "\" is unknown; known are pi, e, sqrt, abs, sin, cos, tan, exp, log, min, max");
        return 0.0;
    }

    std::string_view letters()
    {
        const size_t begin = at_;
        while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])))
            ++at_;
        return text_.substr(begin, at_ - begin);
    }

    double call(const NamedFunction& function)
    {
        if (!take('('))
            fail(std::string(function.name) + " needs an argument in parentheses");
        const double first = message_.empty() ? sum() : 0.0;
        if (message_.empty() && function.arguments == 2 && !take(','))
            fail(std::string(function.name) + " needs two arguments");
        const double second = message_.empty() && function.arguments == 2 ? sum() : 0.0;
        if (message_.empty() && !take(')'))
            fail("a parenthesis is not closed");
        return function.call(first, second);
    }

    /// The text of a unit at this place: letters, digits behind them, and "/" between two such words.
    std::string_view unitText() const
    {
        const auto is = [&](size_t i, auto test) {
            return i < text_.size() && test(static_cast<unsigned char>(text_[i])) != 0;
        };
        const auto isAlpha = [](unsigned char c) { return std::isalpha(c); };
        const auto isDigit = [](unsigned char c) { return std::isdigit(c); };
        size_t end = at_;
        if (end < text_.size() && text_[end] == '%')
            return text_.substr(at_, 1);
        for (; is(end, isAlpha); ++end) {
        }
        for (; end > at_ && is(end, isDigit); ++end) {
        }
        if (end > at_ && end < text_.size() && text_[end] == '/' && is(end + 1, isAlpha)) {
            for (++end; is(end, isAlpha); ++end) {
            }
            for (; is(end, isDigit); ++end) {
            }
        }
        return text_.substr(at_, end - at_);
    }

    double withUnit(double value)
    {
        if (!message_.empty())
            return value;
        skipBlanks();
        const std::string_view name = unitText();
        if (name.empty())
            return value;
        for (const Unit& unit : units())
            if (unit.name == name && unit.of == (unit_.empty() ? "1" : unit_)) {
                at_ += name.size();
                return value * unit.factor + unit.offset;
            }
        std::string fitting;
        for (const std::string& fit : unitsFor(unit_))
            fitting += " " + fit;
        fail("\"" + std::string(name) + "\" is no unit of this member" +
             (fitting.empty() ? "; it has none" : "; units are" + fitting));
        return value;
    }

    std::string_view text_;
    std::string_view unit_;
    size_t at_ = 0;
    size_t place_ = 0;
    int depth_ = 0;
    std::string message_;
};

} // namespace

base::Result<double> evaluate(std::string_view expression, std::string_view unit)
{
    return Parser(expression, unit).run();
}

std::vector<std::string> unitsFor(std::string_view unit)
{
    std::vector<std::string> names;
    for (const Unit& known : units())
        if (known.of == (unit.empty() ? "1" : unit))
            names.emplace_back(known.name);
    return names;
}

} // namespace fx::editor
