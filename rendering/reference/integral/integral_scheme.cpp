#include "rendering/reference/integral/integral_scheme.h"

#include "rendering/reference/integral/ray_records.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace fx::render {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

constexpr std::pair<std::string_view, IntegralMethod> kMethods[] = {
    {"paper", IntegralMethod::Paper}, {"simpson", IntegralMethod::Simpson},
    {"gauss", IntegralMethod::Gauss}, {"positive", IntegralMethod::Positive},
    {"march", IntegralMethod::March}, {"adaptive", IntegralMethod::Adaptive}};

double usualCap(uint32_t nodes)
{
    return nodes == 3 ? 0.5 : nodes == 5 ? 1.0 : 2.0;
}

/// The whole of `text` as a number > 0.
std::optional<double> readNumber(std::string_view text)
{
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0.0))
        return std::nullopt;
    return value;
}

std::string numberText(double value)
{
    char text[400]; // 1e-308 in full
    const auto result = std::to_chars(text, text + sizeof(text), value, std::chars_format::fixed);
    return std::string(text, result.ptr);
}

base::Status refuse(std::string_view name)
{
    return {base::Code::InvalidArgument,
            "unknown integrator '" + std::string(name) +
                "': paper-N (1..64), simpson-N (1..64), gauss-3, gauss-5, gauss-8 (also gauss-5-cap-C), "
                "positive-N (2..64), march-STEP or adaptive-TOLERANCE"};
}

bool isCount(double value, double least, double most)
{
    return value >= least && value <= most && value == std::floor(value);
}

} // namespace

IntegralScheme defaultScheme()
{
    return {};
}

IntegralScheme highScheme()
{
    IntegralScheme scheme;
    scheme.count = 8;
    scheme.cap = usualCap(8);
    return scheme;
}

base::Result<IntegralScheme> parseScheme(std::string_view name)
{
    const size_t dash = name.find('-');
    if (dash == std::string_view::npos)
        return refuse(name);
    IntegralScheme scheme;
    bool isKnown = false;
    for (const auto& [word, method] : kMethods)
        if (name.substr(0, dash) == word) {
            scheme.method = method;
            isKnown = true;
        }
    std::string_view rest = name.substr(dash + 1);
    std::optional<double> cap;
    const size_t capAt = rest.find("-cap-");
    if (capAt != std::string_view::npos) {
        if (scheme.method != IntegralMethod::Gauss)
            return refuse(name);
        const std::string_view text = rest.substr(capAt + 5);
        cap = text == "inf" ? std::optional<double>(kNever) : readNumber(text);
        if (!cap)
            return refuse(name);
        rest = rest.substr(0, capAt);
    }
    const std::optional<double> number = readNumber(rest);
    if (!isKnown || !number || !std::isfinite(*number))
        return refuse(name);

    bool isGood = true;
    if (scheme.method == IntegralMethod::March) {
        scheme.step = *number;
    } else if (scheme.method == IntegralMethod::Adaptive) {
        scheme.tolerance = *number;
        scheme.stopDepth = kNever; // the bound ends the ray
    } else if (scheme.method == IntegralMethod::Gauss) {
        isGood = *number == 3 || *number == 5 || *number == 8;
        scheme.cap = cap ? *cap : usualCap(uint32_t(*number));
    } else {
        isGood = isCount(*number, scheme.method == IntegralMethod::Positive ? 2 : 1, 64);
    }
    if (!isGood)
        return refuse(name);
    if (scheme.method == IntegralMethod::Paper)
        scheme.stopDepth = kNever;
    if (scheme.method != IntegralMethod::March && scheme.method != IntegralMethod::Adaptive)
        scheme.count = uint32_t(*number);
    return scheme;
}

std::string schemeName(const IntegralScheme& scheme)
{
    std::string name;
    for (const auto& [word, method] : kMethods)
        if (method == scheme.method)
            name = std::string(word) + "-";
    if (scheme.method == IntegralMethod::March)
        return name + numberText(scheme.step);
    if (scheme.method == IntegralMethod::Adaptive)
        return name + numberText(scheme.tolerance);
    name += std::to_string(scheme.count);
    if (scheme.method == IntegralMethod::Gauss && scheme.cap != usualCap(scheme.count))
        name += "-cap-" + (std::isfinite(scheme.cap) ? numberText(scheme.cap) : std::string("inf"));
    return name;
}

const std::vector<std::string>& comparedSchemes()
{
    static const std::vector<std::string> names = {
        "paper-1",     "paper-2",       "paper-4",        "paper-16",        "simpson-1",
        "simpson-4",   "gauss-3",       "gauss-5",        "gauss-5-cap-0.5", "gauss-8",
        "positive-4",  "positive-8",    "march-0.1",      "march-0.03",      "march-0.01",
        "march-0.003", "adaptive-0.01", "adaptive-0.001", "adaptive-0.0001"};
    return names;
}

RayWork& RayWork::operator+=(const RayWork& other)
{
    rays += other.rays;
    hits += other.hits;
    intervals += other.intervals;
    parts += other.parts;
    blobSums += other.blobSums;
    nodes += other.nodes;
    exponentials += other.exponentials;
    return *this;
}

} // namespace fx::render
