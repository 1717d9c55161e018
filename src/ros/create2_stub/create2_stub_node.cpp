#include "ros/common/node_main.hpp"
#include "ros/create2_stub/create2_stub.hpp"

int main(int argc, char** argv) {
  using namespace lstm_planner;
  return runNode(argc, argv, "create2_stub", [](const ros::NodeHandle& node) {
    Create2Stub(loadCreate2StubParameters(node)).run();
    return 0;
  });
}
