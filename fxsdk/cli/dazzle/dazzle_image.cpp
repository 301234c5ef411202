#include "fxsdk/cli/dazzle/dazzle_image.h"

#include "fxsdk/cli/dazzle/exr_header.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>

namespace fx::cli {
namespace {

constexpr int kLargestSide = 16384; // [pixel]
constexpr uint64_t kMaxPixels = uint64_t(1) << 25;
constexpr uint64_t kMaxValues = uint64_t(1) << 29;
constexpr size_t kMaxChannels = 256;
constexpr uint64_t kMaxExpansion = 10000; // bytes of picture for a byte of file

base::Status failed(base::Code code, const std::string& path, const std::string& message)
{
    return {code, path + ": " + message};
}

/// Sizes, before any of it is believed.
base::Status checkSize(const std::string& path, uint64_t fileBytes, int64_t width, int64_t height,
                       size_t channels)
{
    if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide ||
        uint64_t(width) * uint64_t(height) > kMaxPixels)
        return failed(base::Code::TooLarge, path,
                      std::to_string(width) + "x" + std::to_string(height) +
                          " pixels; at most 16384 a side and 2^25 in all");
    const uint64_t values = uint64_t(width) * uint64_t(height) * channels;
    if (channels > kMaxChannels || values > kMaxValues)
        return failed(base::Code::TooLarge, path,
                      std::to_string(channels) +
                          " channels of this size; at most 256, and 2^29 values in all");
    if (values * sizeof(float) / kMaxExpansion > fileBytes)
        return failed(base::Code::TooLarge, path, "would grow more than 10,000-fold when it is read");
    return {};
}

base::Result<DazzleImage> readPlanes(const std::string& path, uint64_t fileBytes)
{
    Imf::InputFile file(path.c_str(), 1);
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    const int64_t height = int64_t(window.max.y) - window.min.y + 1;
    size_t channels = 0;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
        ++channels;
    if (base::Status status = checkSize(path, fileBytes, width, height, channels); !status)
        return status;

    DazzleImage image{int(width), int(height), {}, {}, 0};
    if (Imf::hasWhiteLuminance(header))
        image.whiteLuminance = Imf::whiteLuminance(header);
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        const Imf::Channel& channel = it.channel();
        if (channel.xSampling != 1 || channel.ySampling != 1)
            return failed(base::Code::Parse, path, std::string("channel ") + it.name() + " is subsampled");
        if (channel.type == Imf::UINT)
            image.leftOut.push_back(it.name());
        else
            image.planes.push_back({it.name(), channel.type == Imf::HALF, {}});
    }
    Imf::FrameBuffer frame;
    for (DazzlePlane& plane : image.planes) {
        plane.values.resize(size_t(width) * size_t(height));
        frame.insert(plane.name, Imf::Slice::Make(Imf::FLOAT, plane.values.data(), window));
    }
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
}

} // namespace

base::Result<DazzleImage> readDazzleImage(const std::string& path)
{
    std::error_code error;
    const uint64_t bytes = std::filesystem::file_size(path, error);
    if (error)
        return failed(base::Code::Io, path, error.message());
    try {
        std::string beginning(std::min(bytes, kMaxHeaderBytes), '\0');
        std::ifstream file(path, std::ios::binary);
        file.read(beginning.data(), std::streamsize(beginning.size()));
        beginning.resize(size_t(file.gcount()));
        if (const base::Status status = checkExrAttributes(beginning, bytes); !status)
            return failed(status.code(), path, status.message());
        return readPlanes(path, bytes);
    } catch (const std::bad_alloc&) {
        return failed(base::Code::OutOfMemory, path, "not enough memory");
    } catch (const std::exception& problem) {
        return failed(base::Code::Parse, path, problem.what());
    }
}

} // namespace fx::cli
