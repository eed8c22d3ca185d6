#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "shared/recording/message_schemas.hpp"
#include "shared/recording/type_names.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::recording {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(TypeNames, OfRos2AreTranslatedBothWays) {
  EXPECT_EQ(ros_type("sensor_msgs::msg::dds_::Imu_"), "sensor_msgs/msg/Imu");
  EXPECT_EQ(dds_type("sensor_msgs/msg/Imu"), "sensor_msgs::msg::dds_::Imu_");
  EXPECT_EQ(ros_type("Space::Type"), "Space/Type");
  EXPECT_EQ(dds_type("Space/Type"), "Space::Type");
  EXPECT_EQ(dds_type("Bare"), "Bare");
  EXPECT_EQ(ros_topic("rt/cosight/robot/imu"), "/cosight/robot/imu");
  EXPECT_EQ(dds_topic("/cosight/robot/imu"), "rt/cosight/robot/imu");
  EXPECT_EQ(ros_topic("Square"), "Square");
  EXPECT_EQ(dds_topic("Square"), "Square");
}

TEST(Wildcards, StandForAnyCharacters) {
  EXPECT_TRUE(matches("/cosight/robot/imu", "/cosight/*/imu"));
  EXPECT_TRUE(matches("/cosight/robot/imu", "*imu"));
  EXPECT_TRUE(matches("/cosight/robot/imu", "*"));
  EXPECT_TRUE(matches("abc", "a?c"));
  EXPECT_TRUE(matches("aXbXc", "a*X*c"));
  EXPECT_FALSE(matches("/cosight/robot/imu", "/cosight/robot"));
  EXPECT_FALSE(matches("/cosight/robot/imu", "imu"));
  EXPECT_FALSE(matches("", "?"));
  EXPECT_TRUE(matches("", "*"));
}

TEST(Idl, StructsBecomeMessages) {
  const auto definitions = parse_idl(R"idl(
    #include "other.idl"
    module pkg { module msg {
      typedef double double__9[9];  /* as rosidl writes arrays */
      module Thing_Constants {
        const octet A = 1;
        @verbatim (language="comment", text="one; (two)") const string B = "x y";
      };
      enum Colour { RED, GREEN };
      // comment
      @final @verbatim(language = "comment", text = "brackets ) } ;" "more")
      struct Thing {
        @unit(value="m") long long a, b;
        unsigned long long c;
        double__9 d;
        sequence<octet> bytes;
        sequence<string<5>, 3> names;
        other::msg::Part part;
        sequence<Inner> inner;
        Colour colour;
        @default (value=TRUE) boolean yes;
      };
      struct Map { map<string, long> unsayable; };
      struct Last { char x[3]; };
    }; };)idl");
  ASSERT_EQ(definitions.size(), 2U);
  EXPECT_EQ(definitions[0].name, "pkg/msg/Thing");
  EXPECT_EQ(definitions[0].text,
            "uint8 A=1\nstring B=\"x y\"\nint64 a\nint64 b\nuint64 c\nfloat64[9] d\nuint8[] bytes\n"
            "string<=5[<=3] names\nother/Part part\npkg/Inner[] inner\nuint32 colour\nbool yes\n");
  EXPECT_THAT(definitions[0].fields_of, ElementsAre("other/msg/Part", "pkg/msg/Inner"));
  EXPECT_EQ(definitions[1].text, "uint8[3] x\n");
}

TEST(Idl, AnythingIsReadWithoutHarm) {
  const std::string whole = "module a { module msg { struct B { sequence<double, 4> c[2]; }; }; };";
  for (std::size_t size = 0; size < whole.size(); ++size)
    parse_idl(whole.substr(0, size));
  EXPECT_TRUE(parse_idl("} ) > struct").empty());
}

TEST(Schemas, OfEveryTopicAreBuiltIn) {
  const MessageSchemas schemas = MessageSchemas::built_in();
  for (const auto* topic : transport::all_topics()) {
    const std::string type = ros_type(transport::type_name(topic->kind));
    EXPECT_TRUE(schemas.ros2msg(type)) << type;
  }
  EXPECT_FALSE(schemas.ros2msg("unknown/msg/Type"));
}

TEST(Schemas, ContainEveryMessageOnce) {
  const std::string text = MessageSchemas::built_in().ros2msg("sensor_msgs/msg/Imu").value();
  const std::string line(80, '=');
  EXPECT_EQ(text,
            "std_msgs/Header header\n"
            "geometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n"
            "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
            "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n" +
                line + "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" +  //
                line + "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n" +
                line + "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n" +  //
                line + "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
}

TEST(Schemas, ComeFromAFolderOfMsgFiles) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "cosight_msg_folder";
  std::filesystem::create_directories(folder / "my_msgs" / "msg");
  std::ofstream(folder / "my_msgs" / "msg" / "Outer.msg")
      << "# comment with Word\nHeader header  # stamp\nInner[<=3] inner\nfloat64 x 1.5\nuint8 K=3\n";
  std::ofstream(folder / "my_msgs" / "msg" / "Inner.msg") << "string<=4 name\ngeometry_msgs/Point at";
  MessageSchemas schemas = MessageSchemas::built_in();
  schemas.add_folder(folder);
  std::filesystem::remove_all(folder);
  const auto text = schemas.ros2msg("my_msgs/msg/Outer");
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("MSG: my_msgs/Inner\nstring<=4 name\ngeometry_msgs/Point at\n"));
  EXPECT_THAT(*text, HasSubstr("MSG: geometry_msgs/Point\n"));
  EXPECT_THAT(*text, HasSubstr("MSG: std_msgs/Header\n"));
}

}  // namespace
}  // namespace cosight::recording
