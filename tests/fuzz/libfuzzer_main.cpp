// The entry points that libFuzzer calls. The option --write-seeds=FOLDER writes the seeds of the target and
// exits.
#include "tests/fuzz/fuzz_target.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

constexpr std::string_view kWriteSeeds = "--write-seeds=";

int writeSeeds(const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder);
    size_t number = 0;
    for (const std::string& seed : fx::fuzz::seeds()) {
        std::ofstream file(folder / ("seed-" + std::to_string(number++)), std::ios::binary);
        if (!file.write(seed.data(), std::streamsize(seed.size())))
            return 1;
    }
    return 0;
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments)
{
    for (int i = 1; i < *count; ++i) {
        const std::string_view argument = (*arguments)[i];
        if (argument.starts_with(kWriteSeeds))
            std::exit(writeSeeds(argument.substr(kWriteSeeds.size())));
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    fx::fuzz::runInput({data, size});
    return 0;
}
