#include "benchmarks/scenes/quality_options.h"

#include "foundation/result/nearest_name.h"

#include <cstdio>
#include <vector>

namespace fx::cli {

base::Status readSize(const std::string& text, int& outWidth, int& outHeight)
{
    int width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 16 || width > 16'384 ||
        height < 16 || height > 16'384)
        return {base::Code::InvalidArgument,
                "--size: found '" + text + "'; allowed is WIDTHxHEIGHT, each from 16 to 16384, as 320x180"};
    outWidth = width;
    outHeight = height;
    return {};
}

base::Status readClock(const std::string& text, std::optional<StageClock>& outClock)
{
    for (const StageClock clock : {StageClock::Gpu, StageClock::Wall, StageClock::Processor})
        if (text == clockName(clock)) {
            outClock = clock;
            return {};
        }
    const std::vector<std::string> known{"auto", "gpu", "wall", "processor"};
    if (text != "auto")
        return {base::Code::InvalidArgument, "--clock: found '" + text +
                                                 "'; allowed are auto, gpu, wall and processor" +
                                                 base::didYouMean(text, known)};
    outClock.reset();
    return {};
}

} // namespace fx::cli
