#include "fxsdk/cli/support/frame_range.h"

#include <cmath>
#include <cstdlib>

namespace fx::cli {
namespace {

constexpr int64_t kMaxFrames = 1'000'000;

base::Status refused(const std::string& text, const std::string& reason)
{
    return {base::Code::InvalidArgument, "--frames " + text + ": " + reason};
}

} // namespace

std::optional<std::pair<long, long>> parsePair(const std::string& text, char separator)
{
    const char* const begin = text.c_str();
    char* end = nullptr;
    const long first = std::strtol(begin, &end, 10);
    if (end == begin || *end != separator)
        return std::nullopt;
    const char* const rest = end + 1;
    const long second = std::strtol(rest, &end, 10);
    if (end == rest || *end != '\0')
        return std::nullopt;
    return std::make_pair(first, second);
}

base::Result<FrameRange> parseFrameRange(const std::string& text, double framesPerSecond)
{
    FrameRange range{0, std::lround(2.0 * framesPerSecond) - 1};
    if (!text.empty()) {
        const auto parsed = parsePair(text, ':');
        if (!parsed || parsed->first < 0 || parsed->second < parsed->first)
            return refused(text, "expected FIRST:LAST with 0 <= FIRST <= LAST");
        range = {parsed->first, parsed->second};
    }
    if (range.last - range.first >= kMaxFrames || double(range.last) / framesPerSecond > kMaxSceneTime)
        return refused(text, "at most a million frames within the first hour");
    return range;
}

base::Result<std::vector<NumberedFrame>> listFrames(const FrameArguments& arguments, bool isSingleFile,
                                                    double defaultTime, const std::string& sequenceForm,
                                                    const std::string& stillForm)
{
    if (isSingleFile) {
        if (!arguments.frames.empty())
            return base::Status(base::Code::InvalidArgument, "--frames needs " + sequenceForm);
        return std::vector<NumberedFrame>{{0, base::toTicks(arguments.time.value_or(defaultTime))}};
    }
    if (arguments.time)
        return base::Status(base::Code::InvalidArgument, "--time needs " + stillForm);
    const auto range = parseFrameRange(arguments.frames, arguments.framesPerSecond);
    if (!range.ok())
        return range.status();
    std::vector<NumberedFrame> frames;
    for (int64_t number = range->first; number <= range->last; ++number)
        frames.push_back({number, base::toTicks(double(number) / arguments.framesPerSecond)});
    return frames;
}

} // namespace fx::cli
