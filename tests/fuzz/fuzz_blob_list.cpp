// Lists of blobs (*.blobs.csv) for the reference renderer.
#include "fxsdk/cli/render/blob_list_reader.h"
#include "tests/fuzz/fuzz_target.h"

#include <cmath>

namespace fx::fuzz {

void runInput(std::span<const uint8_t> input)
{
    const auto blobs = cli::readBlobList(textOf(input), "input");
    if (!blobs) {
        require(blobs.status().code() == base::Code::Parse, "a list is refused as not well formed");
        require(blobs.status().message().starts_with("input:"), "the message names the file",
                blobs.status().message());
        return;
    }
    for (const render::MediumBlob& blob : *blobs)
        require(std::isfinite(blob.radius) && blob.radius > 0, "radii are positive");
}

std::vector<std::string> seeds()
{
    const std::string head = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb\n";
    return {
        head + "0,1,-2,0.5,0.25,0.9,10,5,1\n1e3,-1e3,0,1e-3,0,0,0,0,0\n",
        head + "0,1,-2,0.5,0.25,0.9,10,5,1\r\n",
        head + "0,1,-2,0,0.25,0.9,10,5,1\n",
        head + "0,1,-2,0.5,0.25,0.9,10,5\n",
        head + "0,1,-2,0.5,0.25,0.9,10,5,nan\n",
        head,
        "x,y,z\n",
    };
}

} // namespace fx::fuzz
