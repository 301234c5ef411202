#include "rendering/compositions/media_compositions.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr MediaComposition kSortedComposition{
    .value = Composition::Sorted,
    .meaning = "balls and cards one over the other, farthest first",
};

constexpr const MediaComposition* kCompositions[] = {
    &kSortedComposition, //
    &kSlabComposition,   //
    &kVolumeComposition,
};

} // namespace

std::span<const MediaComposition* const> mediaCompositions()
{
    return kCompositions;
}

const MediaComposition* findComposition(Composition value)
{
    const auto found =
        std::ranges::find_if(kCompositions, [&](const MediaComposition* one) { return one->value == value; });
    return found == std::end(kCompositions) ? nullptr : *found;
}

} // namespace fx::render
