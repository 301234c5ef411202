// host_ogre [--headless FILE.png] [--frames N] [--size WxH]
//
// A scene of OGRE 1.12 with the render system GL3Plus. OGRE draws into a float texture; a listener of that
// target draws the effects after all objects of the target; a second viewport makes the picture for the
// window. Shows: matrices of an Ogre::Camera, the flipped projection of Ogre's textures, depth of an Ogre
// target, and that Ogre's cache of GL state stays valid. Needs a display (xvfb-run has one).
#include "host_effects.h"
#include "host_options.h"
#include "host_report.h"
#include "host_scene.h"

#include <Ogre.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreRectangle2D.h>
#include <OgreWindowEventUtilities.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

using GLuint = unsigned;

namespace {

constexpr const char* kSurfaceVertex = R"(#version 450 core
in vec4 vertex;
in vec3 normal;
in vec4 colour;
uniform mat4 camera;
out vec3 normalOut;
out vec3 albedo;
void main()
{
    normalOut = normal;
    albedo = colour.rgb;
    gl_Position = camera * vertex;
}
)";
constexpr const char* kSurface = R"(
in vec3 normalOut;
in vec3 albedo;
out vec4 color;
void main() { color = vec4(hostShade(albedo, normalOut), 1.0); }
)";
constexpr const char* kDisplayVertex = R"(#version 450 core
in vec4 vertex;
void main() { gl_Position = vertex; }
)";
constexpr const char* kDisplay = R"(
uniform sampler2D light;
out vec4 color;
void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy); // Ogre stores its textures upside down
    color = vec4(hostToneMap(texelFetch(light, ivec2(at.x, textureSize(light, 0).y - 1 - at.y), 0).rgb), 1.0);
}
)";

/// Ogre's matrices are row-major, those of OpenGL and of fxsdk column-major.
void copyTransposed(const Ogre::Matrix4& matrix, float out[16])
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            out[4 * column + row] = float(matrix[row][column]);
}

Ogre::MaterialPtr makeMaterial(const char* name, const char* vertex, const std::string& fragment)
{
    auto& programs = Ogre::HighLevelGpuProgramManager::getSingleton();
    const auto make = [&](const char* suffix, const std::string& source, Ogre::GpuProgramType type) {
        const auto program =
            programs.createProgram(std::string(name) + suffix, Ogre::RGN_DEFAULT, "glsl", type);
        program->setSource(source);
        program->load();
        return program->getName();
    };
    const auto material = Ogre::MaterialManager::getSingleton().create(name, Ogre::RGN_DEFAULT);
    Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
    pass->setVertexProgram(make(".vertex", vertex, Ogre::GPT_VERTEX_PROGRAM));
    pass->setFragmentProgram(make(".fragment", "#version 450 core\n" + fragment, Ogre::GPT_FRAGMENT_PROGRAM));
    return material;
}

/// Draws the effects into a target of Ogre, after Ogre has drawn all of it: opaque and transparent objects,
/// and overlays, which this scene has not. A game that draws transparent objects over the effects puts them
/// into a render queue after the opaque ones and calls the same from
/// Ogre::RenderQueueListener::renderQueueEnded().
class EffectsListener final : public Ogre::RenderTargetListener
{
public:
    EffectsListener(FxView* view, const Ogre::Camera& camera) : view_(view), camera_(camera) {}

    bool isOn = true;
    bool isRight = true;

    void postRenderTargetUpdate(const Ogre::RenderTargetEvent& event) override
    {
        if (!isOn)
            return;
        GLuint framebuffer = 0;
        event.source->getCustomAttribute("GL_FBOID", &framebuffer);
        Ogre::Matrix4 projection = camera_.getProjectionMatrix(); // depth from -1 to 1, as OpenGL has it
        if (event.source->requiresTextureFlipping())
            for (int column = 0; column < 4; ++column)
                projection[1][column] = -projection[1][column]; // as Ogre draws into textures
        FxFrameDef frame = fxDefaultFrameDef();
        copyTransposed(camera_.getViewMatrix(), frame.view);
        copyTransposed(projection, frame.projection);
        frame.target = FX_TARGET_FRAMEBUFFER;
        frame.framebuffer = framebuffer;
        frame.depthFromFramebuffer = 1; // a renderbuffer that Ogre has chosen
        frame.width = int32_t(event.source->getWidth());
        frame.height = int32_t(event.source->getHeight());
        frame.colorTexture = color;
        hostBeforeEffects(); // measures; a game leaves this out
        // saveState is 1: what Ogre has cached of OpenGL is true afterwards, and no cache has to be cleared.
        isRight = fxView_Render(view_, &frame) == FX_OK;
        hostAfterEffects(&frame);
    }

    GLuint color = 0; ///< the texture of the target: read for heat shimmer and glare

private:
    FxView* view_;
    const Ogre::Camera& camera_;
};

/// Remembers that the user wants to close the window. Ogre would destroy it at once, while effects still need
/// its OpenGL.
class CloseListener final : public OgreBites::WindowEventListener
{
public:
    bool isClosing = false;

    bool windowClosing(Ogre::RenderWindow*) override
    {
        isClosing = true;
        return false;
    }
};

/// Keeps the log of Ogre off files and the output.
struct QuietLog
{
    QuietLog() { manager.createLog("quiet", true, false, true); }
    Ogre::LogManager manager;
};

class Game
{
public:
    explicit Game(const HostOptions& options) : options_(options)
    {
        root_.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
        root_.setRenderSystem(root_.getAvailableRenderers().at(0));
        root_.initialise(false);
        const Ogre::NameValuePairList windowOptions = {{"vsync", "true"}, {"gamma", "false"}};
        window_ = root_.createRenderWindow("fxsdk: OGRE", unsigned(options.width), unsigned(options.height),
                                           false, &windowOptions);
        OgreBites::WindowEventUtilities::_addRenderWindow(window_);
        OgreBites::WindowEventUtilities::addWindowEventListener(window_, &close_);
        Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();
        makeScene();
        makeDisplay();

        const FxGlLoader counted = hostCountCalls(&loader_); // measures; a game passes its loader
        const FxViewSettings settings = hostLight();
        isRight_ = hostOpenEffects(&effects_, &counted, &settings) != 0;
        listener_.emplace(effects_.view, *camera_);
        texture_->getCustomAttribute("GLID", &listener_->color);
        target_->addListener(&*listener_);
    }
    ~Game()
    {
        hostCloseEffects(&effects_); // while Ogre's context still exists
        OgreBites::WindowEventUtilities::removeWindowEventListener(window_, &close_);
        OgreBites::WindowEventUtilities::_removeRenderWindow(window_);
    }
    Game(const Game&) = delete;
    Game& operator=(const Game&) = delete;

    bool play()
    {
        for (int frame = 0; isRight_ && !close_.isClosing && hostPlays(&options_, frame); ++frame) {
            isRight_ = fxScene_Update(effects_.scene, hostStep(&options_)) == FX_OK;
            if (isRight_ && hostDraws(&options_, frame))
                isRight_ = draw(true);
            if (!options_.output)
                window_->swapBuffers();
            OgreBites::WindowEventUtilities::messagePump(); // Ogre itself handles no events of the window
        }
        if (!isRight_)
            std::fprintf(stderr, "ogre: %s\n", fxGetLastErrorMessage());
        return isRight_ && (!options_.output || report());
    }

private:
    void makeScene()
    {
        using namespace Ogre;
        scene_ = root_.createSceneManager();
        const MaterialPtr material =
            makeMaterial("surface", kSurfaceVertex, kHostShadeGlsl + std::string(kSurface));
        material->getTechnique(0)->getPass(0)->getVertexProgramParameters()->setNamedAutoConstant(
            "camera", GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
        static HostVertex vertices[HOST_VERTEX_CAPACITY];
        const int count = hostSceneVertices(vertices);
        ManualObject* const object = scene_->createManualObject();
        object->begin(material, RenderOperation::OT_TRIANGLE_LIST);
        for (int i = 0; i < count; ++i) {
            const HostVertex& v = vertices[i];
            object->position(v.position[0], v.position[1], v.position[2]);
            object->normal(v.normal[0], v.normal[1], v.normal[2]);
            object->colour(v.albedo[0], v.albedo[1], v.albedo[2]);
        }
        object->end();
        scene_->getRootSceneNode()->attachObject(object);

        camera_ = scene_->createCamera("eye");
        camera_->setNearClipDistance(0.1f);
        camera_->setFarClipDistance(0.0f); // infinite
        camera_->setFOVy(Degree(Real(HOST_FIELD_OF_VIEW)));
        camera_->setAspectRatio(Real(options_.width) / Real(options_.height));
        SceneNode* const node =
            scene_->getRootSceneNode()->createChildSceneNode(Vector3(kHostEye[0], kHostEye[1], kHostEye[2]));
        node->attachObject(camera_);
        node->lookAt(Vector3(kHostTarget[0], kHostTarget[1], kHostTarget[2]), Node::TS_WORLD);

        texture_ = TextureManager::getSingleton().createManual("light", RGN_DEFAULT, TEX_TYPE_2D,
                                                               uint(options_.width), uint(options_.height), 0,
                                                               PF_FLOAT16_RGBA, TU_RENDERTARGET);
        target_ = texture_->getBuffer()->getRenderTarget();
        Viewport* const viewport = target_->addViewport(camera_);
        viewport->setBackgroundColour(ColourValue(kHostSky[0], kHostSky[1], kHostSky[2]));
        viewport->setOverlaysEnabled(false);
        target_->setAutoUpdated(false);
    }

    /// A scene of one rectangle, which shows the texture with the curve of the host.
    void makeDisplay()
    {
        using namespace Ogre;
        SceneManager* const display = root_.createSceneManager();
        const MaterialPtr material =
            makeMaterial("display", kDisplayVertex, kHostToneMapGlsl + std::string(kDisplay));
        Pass* const pass = material->getTechnique(0)->getPass(0);
        pass->setDepthCheckEnabled(false);
        pass->setDepthWriteEnabled(false);
        pass->setCullingMode(CULL_NONE);
        pass->createTextureUnitState()->setTexture(texture_);
        pass->getTextureUnitState(0)->setTextureFiltering(TFO_NONE);
        rectangle_ = std::make_unique<Rectangle2D>(false);
        rectangle_->setCorners(-1.0f, 1.0f, 1.0f, -1.0f);
        rectangle_->setBoundingBox(AxisAlignedBox::BOX_INFINITE);
        rectangle_->setMaterial(material);
        display->getRootSceneNode()->attachObject(rectangle_.get());
        window_->addViewport(display->createCamera("display"))->setOverlaysEnabled(false);
        window_->setAutoUpdated(false);
    }

    bool draw(bool withEffects)
    {
        listener_->isOn = withEffects;
        target_->update();
        window_->update(false);
        return listener_->isRight;
    }

    bool report()
    {
        GLuint framebuffer = 0;
        target_->getCustomAttribute("GL_FBOID", &framebuffer);
        const HostReport report = {
            "ogre",
            "GL_RGBA16F, linear",
            "renderbuffer of OGRE, near to far",
            1,
            [](void* game, int with) { return int(static_cast<Game*>(game)->draw(with != 0)); },
            this,
            framebuffer,
            0,
            1};
        return hostReport(&report, &options_, &effects_);
    }

    HostOptions options_;
    QuietLog log_; ///< before Root, which makes a log of its own if there is none
    Ogre::Root root_{"", "", ""};
    CloseListener close_;
    Ogre::RenderWindow* window_ = nullptr;
    Ogre::SceneManager* scene_ = nullptr;
    Ogre::Camera* camera_ = nullptr;
    Ogre::TexturePtr texture_;
    Ogre::RenderTarget* target_ = nullptr;
    std::unique_ptr<Ogre::Rectangle2D> rectangle_;
    FxGlLoader loader_{nullptr, fxGetGlProcAddress}; // finds functions by Ogre's context, which is current
    HostEffects effects_ = {};
    std::optional<EffectsListener> listener_;
    bool isRight_ = false;
};

} // namespace

int main(int argumentCount, char** arguments)
{
    HostOptions options;
    if (!hostParse(argumentCount, arguments, &options))
        return 2;
    try {
        Game game(options);
        return game.play() ? 0 : 1;
    } catch (const std::exception& error) { // Ogre's exceptions are of this kind
        std::fprintf(stderr, "ogre: %s\n", error.what());
        return 1;
    }
}
