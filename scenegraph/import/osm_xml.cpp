#include "scenegraph/import/osm_xml.h"

#include <expat.h>
#include <fcntl.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <exception>
#include <optional>
#include <osmium/builder/osm_object_builder.hpp>
#include <osmium/io/any_compression.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace manzana {
namespace {

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Degrees as the file has them; not a number, or beyond the range, is no place.
std::optional<double> degrees(std::string_view text, double most) {
  const auto value = parse<double>(text);
  return value && std::abs(*value) <= most ? value : std::nullopt;
}

/// Attributes of an element as expat hands them over: name, value, name, value, null.
class Attributes {
 public:
  explicit Attributes(const XML_Char** list) : list_(list) {}
  std::optional<std::string_view> find(std::string_view name) const {
    for (const XML_Char** a = list_; *a != nullptr; a += 2)
      if (name == a[0]) return a[1];
    return std::nullopt;
  }
  std::string_view text(std::string_view name) const { return find(name).value_or(""); }

 private:
  const XML_Char** list_;
};

struct Member {
  osmium::item_type type;
  std::int64_t ref;
  std::string role;
};

/// The object whose element is open.
struct Pending {
  osmium::item_type type = osmium::item_type::undefined;
  std::int64_t id = 0;
  osmium::Location at;
  std::vector<std::pair<std::string, std::string>> tags;
  std::vector<std::int64_t> refs;
  std::vector<Member> members;
};

template <class Builder>
void add_tags(const Pending& object, Builder& builder) {
  if (object.tags.empty()) return;
  osmium::builder::TagListBuilder tags(builder);
  for (const auto& [key, value] : object.tags) tags.add_tag(key, value);
}

const osmium::OSMObject& build(const Pending& object, osmium::memory::Buffer& buffer) {
  buffer.clear();
  if (object.type == osmium::item_type::node) {
    osmium::builder::NodeBuilder builder(buffer);
    builder.set_id(object.id).set_location(object.at);
    add_tags(object, builder);
  } else if (object.type == osmium::item_type::way) {
    osmium::builder::WayBuilder builder(buffer);
    builder.set_id(object.id);
    {
      osmium::builder::WayNodeListBuilder nodes(builder);
      for (const std::int64_t ref : object.refs) nodes.add_node_ref(ref);
    }
    add_tags(object, builder);
  } else {
    osmium::builder::RelationBuilder builder(buffer);
    builder.set_id(object.id);
    {
      osmium::builder::RelationMemberListBuilder members(builder);
      for (const Member& m : object.members) members.add_member(m.type, m.ref, m.role);
    }
    add_tags(object, builder);
  }
  return buffer.get<osmium::OSMObject>(buffer.commit());
}

osmium::item_type type_of(std::string_view name) {
  if (name == "node") return osmium::item_type::node;
  if (name == "way") return osmium::item_type::way;
  return name == "relation" ? osmium::item_type::relation : osmium::item_type::undefined;
}

/// Lives for one file. expat calls C functions: no exception may leave them, so one is kept and thrown after.
class XmlReader {
 public:
  explicit XmlReader(const XmlSink& sink) : sink_(sink), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), on_start, on_end);
    XML_SetEntityDeclHandler(parser_.get(), on_entity);
  }

  void feed(std::string_view text, bool last) {
    constexpr std::size_t kSlice = 1 << 20;  // expat counts in int
    do {
      const std::string_view slice = text.substr(0, kSlice);
      text.remove_prefix(slice.size());
      const bool end = last && text.empty();
      if (XML_Parse(parser_.get(), slice.data(), static_cast<int>(slice.size()), end ? 1 : 0) != XML_STATUS_OK) fail();
    } while (!text.empty());
  }

 private:
  [[noreturn]] void fail() {
    if (error_) std::rethrow_exception(error_);
    throw std::runtime_error("not well-formed XML: " + std::string(XML_ErrorString(XML_GetErrorCode(parser_.get()))) +
                             place());
  }

  std::string line() const { return std::to_string(XML_GetCurrentLineNumber(parser_.get())); }
  std::string place() const {
    return ", line " + line() + ", column " + std::to_string(XML_GetCurrentColumnNumber(parser_.get()) + 1);
  }

  template <class Action>
  static void guarded(void* self, Action action) noexcept {
    auto& reader = *static_cast<XmlReader*>(self);
    if (reader.error_) return;
    try {
      action(reader);
    } catch (...) {
      reader.error_ = std::current_exception();
      XML_StopParser(reader.parser_.get(), XML_FALSE);
    }
  }
  static void on_start(void* self, const XML_Char* name, const XML_Char** list) noexcept {
    guarded(self, [&](XmlReader& reader) { reader.start(name, Attributes(list)); });
  }
  static void on_end(void* self, const XML_Char* /*name*/) noexcept {
    guarded(self, [](XmlReader& reader) { reader.end(); });
  }
  static void on_entity(void* self, const XML_Char*, int, const XML_Char*, int, const XML_Char*, const XML_Char*,
                        const XML_Char*, const XML_Char*) noexcept {
    guarded(self,
            [](XmlReader& reader) { throw std::runtime_error("declares an XML entity: refused" + reader.place()); });
  }

  void start(std::string_view name, Attributes attributes) {
    ++depth_;
    if (depth_ == 1) return start_file(name, attributes);
    if (depth_ == 2) return start_object(name, attributes);
    if (depth_ == 3 && object_.type != osmium::item_type::undefined) start_detail(name, attributes);
  }

  void start_file(std::string_view name, Attributes attributes) {
    if (name != "osm") throw std::runtime_error("not an OpenStreetMap file: top element is not <osm>" + place());
    if (const auto text = attributes.find("attribution")) sink_.attribution(std::string(*text));
  }

  void start_object(std::string_view name, Attributes attributes) {
    object_.type = type_of(name);
    object_.tags.clear();
    object_.refs.clear();
    object_.members.clear();
    if (object_.type == osmium::item_type::undefined || attributes.text("visible") == "false" ||
        attributes.text("action") == "delete") {
      object_.type = osmium::item_type::undefined;
      return;
    }
    const auto id = parse<std::int64_t>(attributes.text("id"));
    if (!id) return drop("line " + line(), "id of a " + std::string(name) + " is not a number of 64 bits");
    object_.id = *id;
    if (object_.type == osmium::item_type::node) locate(attributes);
  }

  void locate(Attributes attributes) {
    const auto lat = degrees(attributes.text("lat"), 90), lon = degrees(attributes.text("lon"), 180);
    if (!lat || !lon) {
      return drop("node " + std::to_string(object_.id) + ", line " + line(), "its place is not on the Earth");
    }
    object_.at = osmium::Location(*lon, *lat);
  }

  void start_detail(std::string_view name, Attributes attributes) {
    if (name == "tag") return add_tag(attributes.text("k"), attributes.text("v"));
    if (name != "nd" && name != "member") return;
    const auto ref = parse<std::int64_t>(attributes.text("ref"));
    if (!ref) return sink_.issue({"line " + line(), "reference is not a number of 64 bits"});
    if (name == "nd") object_.refs.push_back(*ref);
    const osmium::item_type type = type_of(attributes.text("type"));
    if (name == "member" && type != osmium::item_type::undefined)
      object_.members.push_back(
          {type, *ref, std::string(attributes.text("role").substr(0, osmium::max_osm_string_length))});
  }

  /// libosmium refuses longer texts, and so do OpenStreetMap's servers.
  void add_tag(std::string_view key, std::string_view value) {
    if (key.size() > osmium::max_osm_string_length || value.size() > osmium::max_osm_string_length)
      return sink_.issue({"line " + line(), "tag is too long"});
    object_.tags.emplace_back(key, value);
  }

  void drop(std::string where, std::string what) {
    object_.type = osmium::item_type::undefined;
    sink_.issue({std::move(where), std::move(what)});
  }

  void end() {
    if (depth_ == 2 && object_.type != osmium::item_type::undefined) sink_.object(build(object_, buffer_));
    --depth_;
  }

  const XmlSink& sink_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::exception_ptr error_;
  int depth_ = 0;
  Pending object_;
  osmium::memory::Buffer buffer_{1 << 16, osmium::memory::Buffer::auto_grow::yes};
};

std::unique_ptr<osmium::io::Decompressor> open(const osmium::io::File& file) {
  const auto& factory = osmium::io::CompressionFactory::instance();
  if (file.buffer() != nullptr)
    return factory.create_decompressor(file.compression(), file.buffer(), file.buffer_size());
  const int descriptor = ::open(file.filename().c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category());
  return factory.create_decompressor(file.compression(), descriptor);
}

}  // namespace

void read_osm_xml(const osmium::io::File& file, const XmlSink& sink) {
  std::atomic<std::size_t> offset{0};
  const auto source = open(file);
  source->set_offset_ptr(&offset);
  XmlReader reader(sink);
  for (std::string text = source->read(); !text.empty(); text = source->read()) {
    reader.feed(text, false);
    sink.bytes(offset);
  }
  reader.feed("", true);
  source->close();
}

}  // namespace manzana
