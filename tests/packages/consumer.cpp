// A host in C++20, with the objects of fxsdk.hpp.
#include <fxsdk/fxsdk.hpp>

#include <cstdio>
#include <string_view>

int main()
{
    try {
        fxsdk::Context context;
        fxsdk::Scene scene(context);
        FxInstanceDef def = fxsdk::instanceOf(context.loadLibrary("campfire"));
        def.position[1] = 2.0;
        const FxInstanceId fire = scene.create(def);
        if (context.previewSettings(def.preset).exposureEv100 != context.preview(def.preset).exposureEv100)
            return 1;
        FxFrameDef frame = fxDefaultFrameDef();
        frame.width = frame.height = 64;
        frame = context.withCamera(frame, {0.0, 1.0, 5.0}, {0.0, 1.0, 0.0}, 0.9f, 0.1f);
        if (frame.origin[2] != 5.0 || frame.projection[11] != -1.0f)
            return 1;
        scene.advance(1.0);
        const fxsdk::Snapshot snapshot(scene);
        float reach = 0.0f;
        for (uint32_t g = 0; g < snapshot.info().groupsNewer; ++g)
            if (std::string_view(snapshot.group(g).kind) == "blob") {
                const FxSnapshotColumn radius = snapshot.column(g, "radius");
                for (uint32_t i = 0; i < radius.count; ++i)
                    reach = radius.values[i] > reach ? radius.values[i] : reach;
            }
        std::printf("%u particles, largest radius %g m\n", scene.statistics().particles, double(reach));
        if (!scene.isValid(fire) || scene.instances().size() != 1 || !(reach > 0.0f))
            return 1;
        const auto state = scene.saveState();
        scene.update(0.5);
        scene.restoreState(state);
        if (scene.statistics().steps != 60)
            return 1;
        scene.destroy(fire);
        try {
            scene.seek(fire, 0.5);
        } catch (const fxsdk::Error& error) { // the id is stale
            return error.code() == FX_ERROR_STALE_ID ? 0 : 1;
        }
    } catch (const fxsdk::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    return 1;
}
