#include "fxsdk/assets/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace fx::asset {

namespace {

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};

base::Status failure(base::Code code, const std::string& path, const std::string& why)
{
    return {code, path + ": " + why};
}

} // namespace

base::Result<std::string> readFile(const std::string& path, uint64_t maxBytes)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        return failure(base::Code::NotFound, path, "no such file");
    if (error)
        return failure(base::Code::Io, path, error.message());
    if (!std::filesystem::is_regular_file(status)) // a pipe would block, a device might never end
        return failure(base::Code::Io, path, "not a regular file");
    const uint64_t size = std::filesystem::file_size(path, error);
    if (error)
        return failure(base::Code::Io, path, error.message());
    if (size > maxBytes)
        return failure(base::Code::TooLarge, path,
                       "has " + std::to_string(size) + " bytes; at most " + std::to_string(maxBytes) +
                           " are read");

    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (!file)
        return failure(base::Code::Io, path, std::strerror(errno));
    std::string bytes(size, '\0'); // a file that grows meanwhile is read up to the size that was checked
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    if (std::ferror(file.get()))
        return failure(base::Code::Io, path, "reading failed");
    return bytes;
}

} // namespace fx::asset
