#include "motion/fields/plugin_field.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <type_traits>

#include "kinemesh/plugin.h"

namespace kinemesh {
namespace {

constexpr const char* entry_name = "kinemesh_motion_plugin";

[[noreturn]] void refuse(const std::string& library, const std::string& why) {
  throw ParameterError("library", "plug-in " + library + ": " + why);
}

// On one line.
std::string first_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// Where a plug-in puts its reason.
class Message {
 public:
  char* data() { return text_.data(); }
  std::size_t size() const { return text_.size(); }
  std::string text() {
    text_.back() = '\0';
    return text_[0] == '\0' ? "gives no reason" : first_line(text_.data());
  }

 private:
  std::array<char, 512> text_{};
};

// Calls f(message), a function of the plug-in, and returns its reason if it fails, by a code or by throwing
// what should not come through C.
template <class F>
std::string reason_of(const F& f) {
  Message message;
  try {
    return f(message) == 0 ? "" : message.text();
  } catch (const std::exception& error) {
    return first_line(std::string("throws ") + error.what());
  } catch (...) {
    return "throws something";
  }
}

std::string reason_of_loader() {
  const char* text = dlerror();
  return text ? first_line(text) : "no reason is known";
}

// A library that is loaded, and the description it gives of itself.
class Library {
 public:
  explicit Library(const std::string& file) : handle_(open(file), dlclose), plugin_(plugin_of(file)) {}
  const kinemesh_plugin& plugin() const { return *plugin_; }

 private:
  static void* open(const std::string& file) {
    if (!std::filesystem::is_regular_file(file)) refuse(file, "there is no such file");
    void* handle = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) refuse(file, "cannot be loaded: " + reason_of_loader());
    return handle;
  }

  const kinemesh_plugin* plugin_of(const std::string& file) const {
    const auto entry = reinterpret_cast<decltype(&kinemesh_motion_plugin)>(dlsym(handle_.get(), entry_name));
    if (!entry) refuse(file, std::string("has no function ") + entry_name);
    const kinemesh_plugin* plugin = entry();
    if (!plugin) refuse(file, std::string(entry_name) + " returns nothing");
    if (plugin->version != KINEMESH_PLUGIN_VERSION)
      refuse(file, fmt::format("is made for version {} of the interface, {} expected", plugin->version,
                               KINEMESH_PLUGIN_VERSION));
    if (plugin->kind != KINEMESH_PLUGIN_VELOCITY && plugin->kind != KINEMESH_PLUGIN_DISPLACEMENT)
      refuse(file, fmt::format("is of kind {}, 1 (velocity) or 2 (displacement) expected", plugin->kind));
    if (!plugin->evaluate) refuse(file, "has no evaluate");
    return plugin;
  }

  std::unique_ptr<void, int (*)(void*)> handle_;
  const kinemesh_plugin* plugin_;
};

// The numbers of a value; points as x, y, x, y, ...
template <class Value>
std::vector<double> numbers_of(const Value& value) {
  if constexpr (std::is_arithmetic_v<Value>) {
    return {static_cast<double>(value)};
  } else if constexpr (std::is_same_v<Value, std::vector<double>>) {
    return value;
  } else {
    std::vector<double> numbers;
    if constexpr (!std::is_same_v<Value, std::string>)
      for (const auto& point : value) numbers.insert(numbers.end(), {point[0], point[1]});
    return numbers;
  }
}

// One [[motion]]'s use of a library.
class Instance {
 public:
  Instance(const std::string& file, const FieldParameters& parameters) : file_(file), library_(file) {
    if (!plugin().create && !parameters.empty())
      refuse(file, "takes no parameters, " + parameters.begin()->first + " is one");
    if (plugin().create) create(parameters);
  }
  ~Instance() {
    if (plugin().destroy) plugin().destroy(state_);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const kinemesh_plugin& plugin() const { return library_.plugin(); }

  Point operator()(const Point& x, double t) const {
    const double position[2] = {x.x, x.y};
    double result[2] = {0.0, 0.0};
    const std::string why = reason_of([&](Message& message) {
      return plugin().evaluate(state_, t, position, result, message.data(), message.size());
    });
    if (!why.empty())
      throw std::runtime_error(
          fmt::format("plug-in {} fails at ({}, {}), time {}: {}", file_, x.x, x.y, t, why));
    return {result[0], result[1]};
  }

 private:
  void create(const FieldParameters& parameters) {
    std::vector<std::vector<double>> numbers;
    for (const auto& parameter : parameters)
      numbers.push_back(std::visit([](const auto& v) { return numbers_of(v); }, parameter.second));
    std::vector<kinemesh_plugin_parameter> handed;
    for (const auto& parameter : parameters) {
      const auto* text = std::get_if<std::string>(&parameter.second);
      const auto& list = numbers[handed.size()];
      handed.push_back({parameter.first.c_str(), text ? text->c_str() : nullptr, list.data(), list.size()});
    }
    const std::string why = reason_of([&](Message& message) {
      return plugin().create(handed.data(), handed.size(), &state_, message.data(), message.size());
    });
    if (!why.empty()) refuse(file_, why);
  }

  std::string file_;
  Library library_;
  void* state_ = nullptr;
};

class PluginVelocity final : public VelocityField {
 public:
  explicit PluginVelocity(std::shared_ptr<const Instance> plugin) : plugin_(std::move(plugin)) {}
  std::string_view name() const override { return "plugin"; }
  Point velocity(const Point& x, double t) const override { return (*plugin_)(x, t); }

 private:
  std::shared_ptr<const Instance> plugin_;
};

class PluginDisplacement final : public DisplacementField {
 public:
  explicit PluginDisplacement(std::shared_ptr<const Instance> plugin) : plugin_(std::move(plugin)) {}
  std::string_view name() const override { return "plugin"; }
  Point displacement(const Point& initial, double t) const override { return (*plugin_)(initial, t); }

 private:
  std::shared_ptr<const Instance> plugin_;
};

}  // namespace

AnyField make_plugin_field(const std::string& library, const FieldParameters& parameters) {
  auto plugin = std::make_shared<const Instance>(library, parameters);
  if (plugin->plugin().kind == KINEMESH_PLUGIN_VELOCITY)
    return std::make_shared<const PluginVelocity>(std::move(plugin));
  return std::make_shared<const PluginDisplacement>(std::move(plugin));
}

}  // namespace kinemesh
