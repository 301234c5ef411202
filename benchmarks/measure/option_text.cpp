#include "benchmarks/measure/option_text.h"

#include "foundation/result/nearest_name.h"

namespace fx::cli {
namespace {

constexpr uint32_t kMaxParticles = 1u << 28;

/// Whole number at the start of `text`; 0 and `end` at the start where there is none.
uint64_t wholeNumber(const char* text, const char** end)
{
    uint64_t value = 0;
    const char* c = text;
    for (; *c >= '0' && *c <= '9' && value <= kMaxParticles; ++c)
        value = 10 * value + uint64_t(*c - '0');
    *end = c;
    return value;
}

} // namespace

base::Status unknownName(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known)
{
    std::string message = "unknown " + what + " '" + name + "'" + base::didYouMean(name, known);
    message += "; there are";
    for (const std::string& candidate : known)
        message += " " + candidate;
    return {base::Code::InvalidArgument, message};
}

uint32_t particleCount(const std::string& text)
{
    const char* end = nullptr;
    uint64_t count = wholeNumber(text.c_str(), &end);
    if (end != text.c_str() && std::string(end) == "^3")
        count = count <= 1024 ? count * count * count : 0;
    else if (*end != '\0')
        count = 0;
    return count <= kMaxParticles ? uint32_t(count) : 0;
}

} // namespace fx::cli
