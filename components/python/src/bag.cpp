// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <set>

#include "arrays.hpp"
#include "bindings.hpp"
#include "message_values.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/recorder/bag_error.hpp"
#include "panvo/recorder/bag_reader.hpp"

namespace panvo::python {
namespace {

using recorder::BagReader;

/// A recorded message; its members are decoded when they are first asked for.
struct Message {
  std::string topic;
  std::string type;
  std::int64_t stamp_ns = 0;  ///< of recording
  std::shared_ptr<const interfaces::Bytes> bytes;
  py::object values;

  py::object decode() {
    if (values) return values;
    const auto* known = interfaces::find_message_type(type);
    if (known == nullptr) {
      throw interfaces::DecodeError(fmt::format("{}: the type {} {}", topic, type, interfaces::why_unknown(type)));
    }
    values = message_values(*known, bytes);
    return values;
  }
};

/// Iterator over the messages of a bag; threads may share it.
class Messages {
 public:
  Messages(const std::filesystem::path& path, const std::optional<std::set<std::string>>& topics, std::int64_t begin_ns)
      : bag_(path) {
    bag_.select([&](const recorder::BagTopic& topic) { return !topics || topics->contains(topic.name); }, begin_ns);
  }

  Message next() {
    Message message;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      auto* read = bag_.next();
      if (read != nullptr) {
        const auto& topic = bag_.metadata().topics[read->topic];
        message.topic = topic.name;
        message.type = recorder::full_type_name(topic.type);
        message.stamp_ns = read->timestamp_ns;
        message.bytes = std::make_shared<const interfaces::Bytes>(std::move(read->data));
      }
    }
    if (!message.bytes) {
      warn_of_losses();
      throw py::stop_iteration();
    }
    return message;
  }

 private:
  void warn_of_losses() {
    if (is_told_ || bag_.lost_messages() == 0) return;
    is_told_ = true;
    const auto text = fmt::format("{}: {} messages are unreadable: {}", bag_.path().string(), bag_.lost_messages(),
                                  fmt::join(bag_.warnings(), "; "));
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }

  std::mutex mutex_;
  BagReader bag_;
  bool is_told_ = false;
};

/// The description of a bag; each iteration opens it again.
struct Bag {
  explicit Bag(const std::filesystem::path& bag) : path(bag) {
    const BagReader reader(path);
    metadata = reader.metadata();
    for (const auto& topic : metadata.topics) definitions.push_back(reader.definition(topic).text);
    warnings = reader.warnings();
    lost_messages = reader.lost_messages();
  }

  std::filesystem::path path;
  recorder::BagMetadata metadata;
  std::vector<std::string> definitions;
  std::vector<std::string> warnings;
  std::uint64_t lost_messages = 0;
};

struct TopicDescription {
  std::string name, type, definition;
  std::uint64_t message_count = 0;
};

py::dict topics_of(const Bag& bag) {
  py::dict topics;
  for (std::size_t i = 0; i < bag.metadata.topics.size(); ++i) {
    const auto& topic = bag.metadata.topics[i];
    topics[py::str(topic.name)] =
        TopicDescription{topic.name, recorder::full_type_name(topic.type), bag.definitions[i], topic.message_count};
  }
  return topics;
}

/// Names a single topic or several; throws BagError for one that the bag lacks.
std::optional<std::set<std::string>> selection(const Bag& bag, const py::object& topics) {
  if (topics.is_none()) return std::nullopt;
  std::set<std::string> names;
  if (py::isinstance<py::str>(topics)) {
    names.insert(topics.cast<std::string>());
  } else {
    const auto expected = [](const py::handle& found) {
      return py::type_error(fmt::format("topics: expected a name or a list of names, not {}", type_name(found)));
    };
    if (!py::isinstance<py::iterable>(topics)) throw expected(topics);
    for (const auto& name : topics) {
      if (!py::isinstance<py::str>(name)) throw expected(name);
      names.insert(name.cast<std::string>());
    }
  }
  for (const auto& name : names) {
    const auto has_name = [&](const recorder::BagTopic& topic) { return topic.name == name; };
    if (std::none_of(bag.metadata.topics.begin(), bag.metadata.topics.end(), has_name)) {
      std::vector<std::string> known;
      for (const auto& topic : bag.metadata.topics) known.push_back(topic.name);
      throw recorder::BagError(
          fmt::format("{}: has no topic {}; its topics are {}", bag.path.string(), name, fmt::join(known, ", ")));
    }
  }
  return names;
}

std::unique_ptr<Messages> messages(const Bag& bag, const py::object& topics, double start_s) {
  if (!(start_s >= 0.0)) throw py::value_error(fmt::format("start_s: expected 0 or more, not {}", start_s));
  const auto wanted = selection(bag, topics);
  const bool is_whole = start_s == 0.0 || bag.metadata.message_count == 0;
  const auto begin_ns = is_whole ? INT64_MIN : bag.metadata.start_ns + static_cast<std::int64_t>(start_s * 1e9);
  const py::gil_scoped_release release;
  return std::make_unique<Messages>(bag.path, wanted, begin_ns);
}

void bind_message(py::module_& module) {
  py::class_<TopicDescription>(module, "Topic", "A topic of a bag.")
      .def_readonly("name", &TopicDescription::name)
      .def_readonly("type", &TopicDescription::type, "\"sensor_msgs/msg/Image\"")
      .def_readonly("message_count", &TopicDescription::message_count)
      .def_readonly("definition", &TopicDescription::definition, "of the type, as stored in the bag; may be empty")
      .def("__repr__", [](const TopicDescription& topic) {
        return fmt::format("<panvo.Topic {}: {} messages, {}>", topic.name, topic.message_count, topic.type);
      });
  py::class_<Message>(module, "Message", "A recorded message.")
      .def_readonly("topic", &Message::topic)
      .def_readonly("type", &Message::type)
      .def_readonly("stamp_ns", &Message::stamp_ns, "time of recording")
      .def_property_readonly("stamp_s", [](const Message& message) { return seconds(message.stamp_ns); })
      .def_property_readonly(
          "data",
          [](const Message& message) {
            return py::bytes(reinterpret_cast<const char*>(message.bytes->data()), message.bytes->size());
          },
          "the serialised message (CDR) with its encapsulation header")
      .def_property_readonly("values", &Message::decode,
                             "dict of the members: plain values, dicts, lists, and NumPy arrays for numbers; those of "
                             "bytes are read-only. DecodeError if the type is unknown or the message malformed")
      .def("__getitem__", [](Message& message, const py::object& name) { return message.decode()[name]; })
      .def("__repr__", [](const Message& message) {
        return fmt::format("<panvo.Message {}: {}, {} bytes>", message.topic, message.type, message.bytes->size());
      });
  py::class_<Messages>(module, "Messages", "Iterator over the messages of a bag.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &Messages::next);
}

}  // namespace

void bind_bag(py::module_& module) {
  bind_message(module);
  py::class_<Bag>(
      module, "Bag",
      "A rosbag2 folder, or one .db3 or .mcap file, of ROS 2 or panvo. Readable messages of a damaged bag are "
      "read; see warnings and lost_messages.")
      .def(py::init<const std::filesystem::path&>(), py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "BagError with file and remedy if it is not a bag.")
      .def_readonly("path", &Bag::path)
      .def_property_readonly("topics", &topics_of, "Topic by name")
      .def_property_readonly("message_count", [](const Bag& bag) { return bag.metadata.message_count; })
      .def_property_readonly(
          "start_ns",
          [](const Bag& bag) -> std::optional<std::int64_t> {
            return bag.metadata.message_count > 0 ? std::optional(bag.metadata.start_ns) : std::nullopt;
          },
          "time of the first message; None if there is none")
      .def_property_readonly("duration_s", [](const Bag& bag) { return seconds(bag.metadata.duration_ns); })
      .def_readonly("warnings", &Bag::warnings, "recoverable faults, each with its file")
      .def_readonly("lost_messages", &Bag::lost_messages, "recorded messages known to be unreadable")
      .def("messages", &messages, py::arg("topics") = py::none(), py::kw_only(), py::arg("start_s") = 0.0,
           "Messages in order of time, of one topic, a list of topics, or all. Unreadable ones are skipped, with a "
           "RuntimeWarning at the end.")
      .def("__iter__", [](const Bag& bag) { return messages(bag, py::none(), 0.0); })
      .def("__repr__", [](const Bag& bag) {
        return fmt::format("<panvo.Bag {}: {} messages, {} topics>", bag.path.string(), bag.metadata.message_count,
                           bag.metadata.topics.size());
      });
}

}  // namespace panvo::python
