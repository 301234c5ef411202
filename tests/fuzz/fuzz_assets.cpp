// Images and meshes that presets name, by way of the resolver and the asset table.
#include "fxsdk/assets/asset_loader.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/png_repair.h"
#include "tests/presets/small_png.h"

#include <memory_resource>

namespace fx::fuzz {

namespace {

/// Delivers the bytes of an input for every name.
int readInput(void* user, const char*, uint64_t maxBytes, void (*deliver)(void*, const void*, size_t),
              void* sink)
{
    const auto& bytes = *static_cast<const std::vector<uint8_t>*>(user);
    if (bytes.size() > maxBytes)
        return 2;
    deliver(sink, bytes.data(), bytes.size());
    return 0;
}

void checkAsset(const base::Result<base::AssetId>& id, const base::AssetTable& table,
                const std::string& warning, bool mayStandIn)
{
    if (id)
        require(*id > 0 && *id <= table.size(), "an asset has an id of its table");
    else
        require(!mayStandIn && !id.status().message().empty(), "a refused asset has a message",
                id.status().message());
    if (!warning.empty())
        require(mayStandIn, "a placeholder stands in only where the host allows it", warning);
}

} // namespace

/// The first bytes choose the kind of the asset, its frames, and what becomes of a damaged one.
void runInput(std::span<const uint8_t> input)
{
    InputReader reader(input);
    const uint8_t kind = reader.byte();
    const bool mayStandIn = reader.one(2);
    const int columns = 1 + int(reader.below(4)), rows = 1 + int(reader.below(4));
    std::vector<uint8_t> bytes(reader.rest().begin(), reader.rest().end());
    if (kind != 'm')
        repairPng(bytes);

    const asset::AssetResolver resolver("", {}, {&bytes, &readInput});
    base::AssetTable table(std::pmr::get_default_resource());
    const auto missing = mayStandIn ? asset::MissingAsset::ShowsPlaceholder : asset::MissingAsset::IsAnError;
    asset::AssetLoader loader(resolver, table, missing, "folder/");
    for (int round = 0; round < 2; ++round) { // equal content gets the same id
        std::string warning;
        if (kind == 'm')
            checkAsset(loader.mesh("mesh.obj", warning), table, warning, mayStandIn);
        else
            checkAsset(loader.image("image.png",
                                    kind == 'n' ? asset::ImageUse::Numbers : asset::ImageUse::Color, columns,
                                    rows, warning),
                       table, warning, mayStandIn);
    }
    require(table.size() <= 1, "equal content is kept once");
}

std::vector<std::string> seeds()
{
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    return {
        std::string("i\1\0\0", 4) + test::smallPng(), std::string("i\0\1\0", 4) + test::smallPng(),
        std::string("i\1\0\1", 4) + test::smallPng(), std::string("n\0\0\0", 4) + test::smallPng(),
        std::string("m\1\0\0", 4) + triangle,         std::string("m\0\0\0", 4) + "v 0 0\n",
    };
}

} // namespace fx::fuzz
