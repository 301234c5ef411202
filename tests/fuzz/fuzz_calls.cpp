// Recordings of calls of the C API; see calls_player.h.
#include "tests/fuzz/calls_player.h"

namespace fx::fuzz {

#if !FX_FUZZ_WITH_GL
const GlHost& glHost()
{
    static const GlHost none;
    return none;
}
#endif

void runInput(std::span<const uint8_t> input)
{
    CallsPlayer(input).play();
}

/// Every function several times, in an order that has something for each to do.
std::vector<std::string> seeds()
{
    enum Group
    {
        kContexts,
        kScenes,
        kViews
    };
    constexpr size_t kCallBytes = 32;
    std::vector<std::string> all;
    for (int variant = 0; variant < 12; ++variant) {
        std::string calls;
        const auto add = [&](Group group, int call, std::initializer_list<int> arguments = {}) {
            std::string record{char(group), char(call)};
            for (const int byte : arguments)
                record += char(byte);
            record.resize(kCallBytes, char(variant >= 8 ? variant : 0)); // in the later ones no argument is 0
            calls += record;
        };
        add(kContexts, 0, {0, 0, 0, 0});
        add(kContexts, 3, {0, variant}); // presets
        add(kContexts, 3, {0, variant + 1});
        add(kContexts, 2, {0, 0, variant % 4 == 3 ? 20 : 0}); // callbacks that call
        for (int call = 0; call < 5; ++call)
            add(kScenes, call, {0, 0, 0, 0});
        add(kScenes, 1, {0, 0, 0, 1});
        for (int call = 0; call < 16; ++call) {
            add(kScenes, call, {0, 0, variant % 3, call, 9, 9, 9, 9});
            add(kScenes, 2, {0, 0, 9});
            if (call % 4 == 1)
                add(kViews, call / 4, {0, 0});
        }
        for (int call = 0; call < 6; ++call)
            add(kViews, call, {0, 0, 0, 0, 0, 0});
        add(kScenes, 16, {0, 0});
        add(kContexts, 5, {0, 0});
        all.push_back(calls);
    }
    return all;
}

} // namespace fx::fuzz
