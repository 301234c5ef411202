// Replays the seeds of a fuzz target and the files that the arguments name, where there is no libFuzzer.
#include "tests/fuzz/fuzz_target.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

std::vector<std::filesystem::path> filesOf(const std::filesystem::path& path)
{
    if (!std::filesystem::is_directory(path))
        return {path};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
        if (entry.is_regular_file())
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

void replay(const std::string& name, const std::string& input)
{
    std::printf("%s, %zu bytes\n", name.c_str(), input.size());
    std::fflush(stdout); // the last line names the input that ended the process
    fx::fuzz::runInput({reinterpret_cast<const uint8_t*>(input.data()), input.size()});
}

} // namespace

int main(int count, char** arguments)
{
    size_t number = 0;
    for (const std::string& seed : fx::fuzz::seeds())
        replay("seed " + std::to_string(number++), seed);
    for (int i = 1; i < count; ++i)
        for (const std::filesystem::path& path : filesOf(arguments[i])) {
            std::ifstream file(path, std::ios::binary);
            if (!file) {
                std::fprintf(stderr, "cannot read %s\n", path.c_str());
                return 1;
            }
            replay(path.string(), {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
            ++number;
        }
    std::printf("%zu inputs replayed\n", number);
    return number > 0 ? 0 : 1;
}
