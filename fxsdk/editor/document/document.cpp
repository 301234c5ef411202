#include "fxsdk/editor/document/document.h"

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/presets/json_parser.h"
#include "fxsdk/presets/preset_loader.h"

#include <set>

namespace fx::editor {

namespace {

using Pointer = Json::json_pointer;
using base::Code;
using base::Status;

DocumentKind kindOf(const std::string& path)
{
    return path.ends_with(".scene.json") ? DocumentKind::Scene : DocumentKind::Preset;
}

const preset::JsonLimits& limitsOf(DocumentKind kind)
{
    return kind == DocumentKind::Preset ? preset::kPresetLimits : preset::kSceneLimits;
}

/// Parses with the checks of the preset reader, and keeps the order of members.
base::Result<Json> parse(const std::string& text, const std::string& path, DocumentKind kind)
{
    preset::Findings findings;
    const auto checked = preset::parseJson(text, limitsOf(kind), findings);
    if (!checked)
        return Status(findings.firstCode(), preset::summary(findings.locate(text, path)));
    if (!checked->is_object())
        return Status(Code::Schema,
                      path + ": found " + checked->type_name() + std::string("; a preset is an object"));
    return Json::parse(text);
}

Status refuse(const std::string& pointer, const std::string& reason)
{
    return {Code::InvalidArgument, pointer + ": " + reason};
}

/// `name` with the lowest number from 2 on that makes it differ from all names in `array`.
std::string freeName(const Json& array, const std::string& name)
{
    std::set<std::string> taken;
    for (const Json& element : array)
        if (element.is_object() && element.contains("name") && element["name"].is_string())
            taken.insert(element["name"].get<std::string>());
    for (int number = 2;; ++number)
        if (std::string candidate = name + " " + std::to_string(number); !taken.contains(candidate))
            return candidate;
}

} // namespace

base::Result<Document> Document::open(const std::string& path)
{
    const bool isOfLibrary = path.starts_with("library:");
    const DocumentKind kind = kindOf(path);
    const asset::AssetResolver library("", preset::libraryFiles());
    const auto text = isOfLibrary ? library.read(path.ends_with(".fx.json") ? path : path + ".fx.json",
                                                 preset::kPresetBytes)
                                  : asset::readFile(path, limitsOf(kind).bytes);
    if (!text)
        return text.status();
    auto document = fromText(*text, isOfLibrary ? std::string() : path);
    return document;
}

base::Result<Document> Document::fromText(const std::string& text, const std::string& path)
{
    Document document;
    document.kind_ = kindOf(path);
    auto json = parse(text, path.empty() ? "preset" : path, document.kind_);
    if (!json)
        return json.status();
    document.path_ = path;
    document.json_ = document.savedJson_ = std::move(*json);
    document.savedText_ = text;
    return document;
}

std::string Document::text() const
{
    return writeJson(json_, savedJson_, savedText_);
}

void Document::apply(const std::string& label, const std::string& pointer, Json after, uint64_t gesture)
{
    Json before = json_.at(Pointer(pointer));
    if (before == after && before.type() == after.type())
        return;
    history_.apply(json_, {label, pointer, std::move(before), std::move(after), gesture});
    ++revision_;
}

Status Document::set(const std::string& pointer, Json value, uint64_t gesture)
{
    const Pointer target(pointer);
    if (!json_.contains(target))
        return insertMember(target, std::move(value), gesture);
    const std::string added = addedBy(gesture, pointer);
    if (added.empty()) {
        apply("set " + pointer, pointer, std::move(value), gesture);
        return {};
    }
    Json around = json_.at(Pointer(added));
    around[Pointer(pointer.substr(added.size()))] = std::move(value);
    apply("add " + pointer, added, std::move(around), gesture);
    return {};
}

/// The object around `pointer` to which the gesture has added the member before; empty if it has not.
std::string Document::addedBy(uint64_t gesture, const std::string& pointer) const
{
    if (gesture == 0 || !history_.canUndo())
        return {};
    const Edit& last = history_.edits()[history_.done() - 1];
    const bool isAround = last.gesture == gesture && pointer.starts_with(last.pointer + "/");
    return isAround ? last.pointer : std::string();
}

/// Adds a member, with the objects around it that are absent, as one edit of the nearest object that exists.
Status Document::insertMember(const Pointer& pointer, Json value, uint64_t gesture)
{
    Pointer parent = pointer;
    std::string key = parent.back();
    parent.pop_back();
    while (!json_.contains(parent)) {
        value = Json::object({{key, std::move(value)}});
        key = parent.back();
        parent.pop_back();
    }
    Json object = json_.at(parent);
    if (!object.is_object())
        return refuse(pointer.to_string(),
                      object.is_array() ? "there is no such element" : "the value around it has no members");
    const Json* const schema = schemaAt(this->schema(), json_, parent);
    const size_t index = canonicalIndex(object, key, schema);
    Json extended = Json::object();
    size_t at = 0;
    for (auto it = object.begin(); it != object.end(); ++it, ++at) {
        if (at == index)
            extended[key] = value;
        extended[it.key()] = *it;
    }
    if (index >= object.size())
        extended[key] = std::move(value);
    apply("add " + pointer.to_string(), parent.to_string(), std::move(extended), gesture);
    return {};
}

Status Document::erase(const std::string& pointer)
{
    const Pointer target(pointer);
    if (target.empty() || !json_.contains(target))
        return {Code::NotFound, pointer + ": there is no such member"};
    Pointer parent = target;
    parent.pop_back();
    Json container = json_.at(parent);
    if (container.is_array())
        container.erase(size_t(std::stoul(target.back())));
    else
        container.erase(target.back());
    apply("remove " + pointer, parent.to_string(), std::move(container));
    return {};
}

Status Document::insert(const std::string& array, size_t index, Json value)
{
    const Pointer target(array);
    if (!json_.contains(target)) {
        if (index != 0)
            return refuse(array, "there is no such array");
        return insertMember(target, Json::array({std::move(value)}));
    }
    Json elements = json_.at(target);
    if (!elements.is_array() || index > elements.size())
        return refuse(array, elements.is_array() ? "there is no such element" : "it is no array");
    elements.insert(elements.begin() + std::ptrdiff_t(index), std::move(value));
    apply("add " + array + "/" + std::to_string(index), array, std::move(elements));
    return {};
}

Status Document::checkElement(const std::string& array, size_t index) const
{
    const Pointer target(array);
    if (!json_.contains(target) || !json_.at(target).is_array())
        return refuse(array, "it is no array");
    return index < json_.at(target).size() ? Status() : refuse(array, "there is no such element");
}

Status Document::move(const std::string& array, size_t from, size_t to)
{
    if (Status status = checkElement(array, from); !status)
        return status;
    if (Status status = checkElement(array, to); !status)
        return status;
    Json elements = json_.at(Pointer(array));
    Json moved = elements[from];
    elements.erase(from);
    elements.insert(elements.begin() + std::ptrdiff_t(to), std::move(moved));
    apply("move " + array + "/" + std::to_string(from), array, std::move(elements));
    return {};
}

Status Document::duplicate(const std::string& array, size_t index)
{
    if (Status status = checkElement(array, index); !status)
        return status;
    const Json& elements = json_.at(Pointer(array));
    Json copy = elements[index];
    if (copy.is_object() && copy.contains("name") && copy["name"].is_string())
        copy["name"] = freeName(elements, copy["name"].get<std::string>());
    return insert(array, index + 1, std::move(copy));
}

void Document::replace(Json document, const std::string& label)
{
    apply(label, "", std::move(document));
}

bool Document::undo()
{
    const bool isUndone = history_.undo(json_);
    revision_ += isUndone ? 1 : 0;
    return isUndone;
}

bool Document::redo()
{
    const bool isRedone = history_.redo(json_);
    revision_ += isRedone ? 1 : 0;
    return isRedone;
}

Status Document::write(const std::string& path)
{
    std::string written = text();
    if (Status status = cli::writeFileAtomically(path, written); !status)
        return status;
    savedJson_ = json_;
    savedText_ = std::move(written);
    path_ = path;
    return {};
}

Status Document::save(bool force)
{
    if (path_.empty())
        return refuse("the document", "it is without a file; save it under a name");
    const auto present = asset::readFile(path_, limitsOf(kind_).bytes);
    if (!force && present && *present != savedText_)
        return refuse(path_, "the file has changed outside of the editor; reload it, or save over it");
    return write(path_);
}

Status Document::saveAs(const std::string& path)
{
    if (kindOf(path) != kind_)
        return refuse(path, kind_ == DocumentKind::Scene
                                ? "names of scenes end in .scene.json"
                                : "the name of a preset must not end in .scene.json");
    return write(path);
}

Status Document::reload(const std::string& text)
{
    auto json = parse(text, path_, kind_);
    if (!json)
        return json.status();
    apply("reload", "", *json);
    savedJson_ = std::move(*json);
    savedText_ = text;
    return {};
}

Status Document::acceptFileText(const std::string& text)
{
    auto json = parse(text, path_, kind_);
    if (!json)
        return json.status();
    savedJson_ = std::move(*json);
    savedText_ = text;
    return {};
}

} // namespace fx::editor
