// Quality calibrations: JSON that hosts hand to fxView_SetQualityCalibration.
#include "fxsdk/quality/calibration_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace fx::fuzz {

void runInput(std::span<const uint8_t> input)
{
    const auto calibration = quality::readCalibration(textOf(input), "input");
    if (!calibration) {
        const auto code = calibration.status().code();
        require(code == base::Code::Parse || code == base::Code::TooLarge || code == base::Code::Version ||
                    code == base::Code::Schema,
                "a calibration is refused with a documented code", calibration.status().message());
        require(!calibration.status().message().empty(), "a refused calibration has a message");
        return;
    }
    const std::string written = quality::calibrationText(*calibration);
    const auto again = quality::readCalibration(written, "written");
    require(again.ok(), "a written calibration can be read", again.ok() ? "" : again.status().message());
    require(quality::calibrationText(*again) == written, "a written calibration is read as it was");
}

std::vector<std::string> seeds()
{
    const auto builtIn = quality::builtInCalibration();
    require(builtIn.ok(), "the built-in calibration is valid");
    return {quality::calibrationText(*builtIn),  "{}", "{\"version\": 1}",
            "{\"version\": 2, \"ladders\": []}", "[]", ""};
}

} // namespace fx::fuzz
