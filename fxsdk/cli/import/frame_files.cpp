#include "fxsdk/cli/import/frame_files.h"

#include "foundation/assets/volume_sequence.h"
#include "fxsdk/cli/support/frame_range.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <vector>

namespace fx::cli {
namespace {

using base::Code;
using base::Status;

constexpr long kLastFrame = 1'000'000;

Status tooMany(const std::string& what)
{
    return {Code::TooLarge, what + ": a sequence has at most " + std::to_string(base::kMaxSequenceFrames) +
                                " frames, up to the number " + std::to_string(kLastFrame) +
                                "; choose some by --frames"};
}

/// The numbers of all files that the name stands for, ascending.
std::vector<uint32_t> numbersOfFiles(const NumberedFile& input)
{
    const std::string name = input.path.filename().string();
    const std::string before = name.substr(0, input.numberAt);
    const std::string behind = name.substr(input.numberAt + input.numberLength);
    const std::filesystem::path folder = input.path.parent_path();
    std::vector<uint32_t> numbers;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::string file = entry.path().filename().string();
        if (file.size() <= before.size() + behind.size() || !file.starts_with(before) ||
            !file.ends_with(behind))
            continue;
        uint32_t number = 0;
        const char* const first = file.data() + before.size();
        const char* const last = file.data() + file.size() - behind.size();
        const auto [end, failure] = std::from_chars(first, last, number);
        if (failure == std::errc() && end == last && number <= kLastFrame &&
            input.frame(number).filename().string() == file)
            numbers.push_back(number);
    }
    std::ranges::sort(numbers);
    return numbers;
}

} // namespace

base::Result<FrameNumbers> chooseFrames(const NumberedFile& input, const std::string& range)
{
    if (!range.empty()) {
        const auto ends = parsePair(range, ':');
        if (!ends || ends->first < 0 || ends->second < ends->first)
            return Status(Code::InvalidArgument, "--frames " + range + ": expected FIRST:LAST, such as 1:24");
        if (ends->second > kLastFrame || ends->second - ends->first >= long(base::kMaxSequenceFrames))
            return tooMany("--frames " + range);
        return FrameNumbers{uint32_t(ends->first), uint32_t(ends->second - ends->first + 1)};
    }
    const std::vector<uint32_t> numbers = numbersOfFiles(input);
    if (numbers.empty())
        return Status(Code::NotFound, input.path.string() + ": found no file with a number in its place");
    for (size_t i = 1; i < numbers.size(); ++i)
        if (numbers[i] != numbers[i - 1] + 1)
            return Status(Code::NotFound,
                          input.frame(numbers[i - 1] + 1).string() + ": this frame is missing between " +
                              std::to_string(numbers.front()) + " and " + std::to_string(numbers.back()) +
                              "; choose a range by --frames");
    if (numbers.size() > base::kMaxSequenceFrames)
        return tooMany(input.path.string());
    return FrameNumbers{numbers.front(), uint32_t(numbers.size())};
}

} // namespace fx::cli
