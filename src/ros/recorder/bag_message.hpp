#pragma once

#include <ros/serialization.h>
#include <rosbag/message_instance.h>

#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace lstm_planner {

/// Reads the bytes of a message. Unlike ROS's own stream it takes no memory for a list of which the bytes cannot be
/// there: a length of four bytes could ask for 16 GB. Throws ros::serialization::StreamOverrunException.
class MessageBytes : public ros::serialization::IStream {
 public:
  MessageBytes(std::uint8_t* data, std::uint32_t size) : IStream(data, size) {}

  template <typename T>
  void next(T& value) {
    ros::serialization::deserialize(*this, value);
  }

  template <typename T, typename Allocator>
  void next(std::vector<T, Allocator>& list) {
    std::uint32_t length = 0;
    if (getLength() >= sizeof(length)) {
      std::memcpy(&length, getData(), sizeof(length));
      static const std::uint64_t least = ros::serialization::serializationLength(T());
      if (length * least > getLength() - sizeof(length)) ros::serialization::throwStreamOverrun();
    }
    ros::serialization::deserialize(*this, list);
  }
};

/// A bag's message; null when it is of another type. Throws ros::Exception when its bytes are not those of such a
/// message.
template <typename Message>
boost::shared_ptr<const Message> messageOf(const rosbag::MessageInstance& instance) {
  if (!instance.isType<Message>()) return nullptr;
  const std::uint32_t size = instance.size();
  std::vector<std::uint8_t> bytes(size + std::size_t{1});  // one more, as an empty vector has no address
  ros::serialization::OStream copy(bytes.data(), size);
  instance.write(copy);
  MessageBytes stream(bytes.data(), size);
  auto message = boost::make_shared<Message>();
  ros::serialization::deserialize(stream, *message);
  return message;
}

}  // namespace lstm_planner
