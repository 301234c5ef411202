// OpenEXR pictures that `fx dazzle` reads.
#include "fxsdk/cli/dazzle/dazzle_image.h"
#include "rendering/exr/exr_encoder.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/scratch_file.h"

namespace fx::fuzz {

void runInput(std::span<const uint8_t> input)
{
    const ScratchFile file(input);
    const auto image = cli::readDazzleImage(file.path());
    if (!image) {
        const auto code = image.status().code();
        require(code == base::Code::Parse || code == base::Code::TooLarge || code == base::Code::OutOfMemory,
                "a picture is refused with a documented code", image.status().message());
        require(image.status().message().starts_with(file.path()), "the message names the file");
        return;
    }
    require(image->width >= 1 && image->height >= 1, "a picture has pixels");
    for (const cli::DazzlePlane& plane : image->planes)
        require(plane.values.size() == size_t(image->width) * size_t(image->height),
                "a plane has all its values");
}

std::vector<std::string> seeds()
{
    std::vector<float> values(size_t(5) * 3 * 4);
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = float(i) * 0.25f;
    std::vector<std::string> all;
    for (const render::ExrPrecision precision : {render::ExrPrecision::Half, render::ExrPrecision::Float}) {
        render::ExrImage image{5, 3, {}, 100.0f};
        render::addRgba(image, "", values, precision);
        render::addRgba(image, "fire", values, precision);
        const auto file = render::encodeExr(image);
        require(file.ok(), "a small picture can be written");
        all.push_back(*file);
        all.push_back(file->substr(0, file->size() / 2));
    }
    return all;
}

} // namespace fx::fuzz
