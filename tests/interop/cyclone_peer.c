/* A program of another DDS vendor (Eclipse Cyclone DDS), built from the same IDL files.
 *
 *   cyclone_peer receive DOMAIN   prints every field of one sample of each of the wearable's topics, as "name
 * value" cyclone_peer send DOMAIN      publishes one raw image and one orientation until it is killed
 */
#include <dds/dds.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sensor_msgs.h"

enum { kTopics = 4, kWidth = 320, kHeight = 240 };

/* The IDL's module path, as ROS 2 announces it: with dds_ before the name and an underscore after it. */
static dds_entity_t ros2_topic(dds_entity_t participant, const dds_topic_descriptor_t* descriptor,
                               const char* ros2_type, const char* name) {
  dds_topic_descriptor_t renamed = *descriptor;
  renamed.m_typename = ros2_type;
  return dds_create_topic(participant, &renamed, name, NULL, NULL);
}

static void print_octets(const char* name, const dds_sequence_octet* octets) {
  uint64_t hash = UINT64_C(14695981039346656037); /* FNV-1a */
  for (uint32_t i = 0; i < octets->_length; ++i)
    hash = (hash ^ octets->_buffer[i]) * UINT64_C(1099511628211);
  printf("%s.length %" PRIu32 "\n%s.hash %" PRIu64 "\n", name, octets->_length, name, hash);
}

static void print_doubles(const char* name, const double* values, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i)
    printf("%s.%" PRIu32 " %.17g\n", name, i, values[i]);
}

static void print_header(const char* name, const std_msgs_msg_Header* header) {
  printf("%s.sec %" PRId32 "\n%s.nanosec %" PRIu32 "\n%s.frame_id %s\n", name, header->stamp.sec, name,
         header->stamp.nanosec, name, header->frame_id);
}

static void print_compressed(const void* sample) {
  const sensor_msgs_msg_CompressedImage* m = sample;
  print_header("compressed", &m->header);
  printf("compressed.format %s\n", m->format);
  print_octets("compressed.data", &m->data);
}

static void print_image(const void* sample) {
  const sensor_msgs_msg_Image* m = sample;
  print_header("image", &m->header);
  printf("image.height %" PRIu32 "\nimage.width %" PRIu32 "\nimage.encoding %s\n", m->height, m->width,
         m->encoding);
  printf("image.is_bigendian %d\nimage.step %" PRIu32 "\n", m->is_bigendian, m->step);
  print_octets("image.data", &m->data);
}

static void print_camera_info(const void* sample) {
  const sensor_msgs_msg_CameraInfo* m = sample;
  print_header("info", &m->header);
  printf("info.height %" PRIu32 "\ninfo.width %" PRIu32 "\ninfo.model %s\n", m->height, m->width,
         m->distortion_model);
  print_doubles("info.d", m->d._buffer, m->d._length);
  print_doubles("info.k", m->k, 9);
  print_doubles("info.r", m->r, 9);
  print_doubles("info.p", m->p, 12);
  printf("info.binning_x %" PRIu32 "\ninfo.binning_y %" PRIu32 "\n", m->binning_x, m->binning_y);
  printf("info.roi %" PRIu32 "/%" PRIu32 "/%" PRIu32 "/%" PRIu32 "/%d\n", m->roi.x_offset, m->roi.y_offset,
         m->roi.height, m->roi.width, m->roi.do_rectify);
}

static void print_vector(const char* name, const geometry_msgs_msg_Vector3* v) {
  printf("%s.x %.17g\n%s.y %.17g\n%s.z %.17g\n", name, v->x, name, v->y, name, v->z);
}

static void print_imu(const void* sample) {
  const sensor_msgs_msg_Imu* m = sample;
  print_header("imu", &m->header);
  printf("imu.q.x %.17g\nimu.q.y %.17g\n", m->orientation.x, m->orientation.y);
  printf("imu.q.z %.17g\nimu.q.w %.17g\n", m->orientation.z, m->orientation.w);
  print_vector("imu.omega", &m->angular_velocity);
  print_vector("imu.a", &m->linear_acceleration);
  print_doubles("imu.q_covariance", m->orientation_covariance, 9);
  print_doubles("imu.omega_covariance", m->angular_velocity_covariance, 9);
  print_doubles("imu.a_covariance", m->linear_acceleration_covariance, 9);
}

struct subscription {
  const dds_topic_descriptor_t* descriptor;
  const char* type;
  const char* topic;
  void (*print)(const void* sample);
  dds_entity_t reader;
  int received;
};

static int take_and_print(struct subscription* subscription) {
  void* sample[1] = {NULL};
  dds_sample_info_t info;
  if (dds_take(subscription->reader, sample, &info, 1, 1) < 1) return 0;
  const int valid = info.valid_data && !subscription->received;
  if (valid) subscription->print(sample[0]);
  dds_return_loan(subscription->reader, sample, 1);
  subscription->received |= valid;
  return valid;
}

static int receive(dds_entity_t participant) {
  struct subscription all[kTopics] = {
      {&sensor_msgs_msg_CompressedImage_desc, "sensor_msgs::msg::dds_::CompressedImage_",
       "rt/cosight/wearable/image/compressed", print_compressed, 0, 0},
      {&sensor_msgs_msg_Image_desc, "sensor_msgs::msg::dds_::Image_", "rt/cosight/wearable/image",
       print_image, 0, 0},
      {&sensor_msgs_msg_CameraInfo_desc, "sensor_msgs::msg::dds_::CameraInfo_",
       "rt/cosight/wearable/camera_info", print_camera_info, 0, 0},
      {&sensor_msgs_msg_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/cosight/wearable/imu", print_imu, 0,
       0}};
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  for (int i = 0; i < kTopics; ++i) {
    const dds_entity_t topic = ros2_topic(participant, all[i].descriptor, all[i].type, all[i].topic);
    all[i].reader = dds_create_reader(participant, topic, qos, NULL);
    if (all[i].reader < 0) return 3;
  }
  int left = kTopics;
  for (int tries = 0; tries < 2000 && left > 0; ++tries) {
    for (int i = 0; i < kTopics; ++i)
      left -= take_and_print(&all[i]);
    dds_sleepfor(DDS_MSECS(10));
  }
  return left == 0 ? 0 : 4;
}

static int send_until_killed(dds_entity_t participant) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t images =
      dds_create_writer(participant,
                        ros2_topic(participant, &sensor_msgs_msg_Image_desc, "sensor_msgs::msg::dds_::Image_",
                                   "rt/cosight/wearable/image"),
                        qos, NULL);
  const dds_entity_t orientations =
      dds_create_writer(participant,
                        ros2_topic(participant, &sensor_msgs_msg_Imu_desc, "sensor_msgs::msg::dds_::Imu_",
                                   "rt/cosight/wearable/imu"),
                        qos, NULL);

  static uint8_t pixels[kWidth * kHeight];
  for (uint32_t i = 0; i < sizeof pixels; ++i)
    pixels[i] = (uint8_t)(i * 7U + i / kWidth);
  sensor_msgs_msg_Image image;
  memset(&image, 0, sizeof image);
  image.header.stamp.sec = 1700000000;
  image.header.stamp.nanosec = 123456789;
  image.header.frame_id = (char*)"cyclone";
  image.width = kWidth;
  image.height = kHeight;
  image.encoding = (char*)"mono8";
  image.step = kWidth;
  image.data._buffer = pixels;
  image.data._length = image.data._maximum = sizeof pixels;

  sensor_msgs_msg_Imu imu;
  memset(&imu, 0, sizeof imu);
  imu.header = image.header;
  imu.orientation.x = 0.1;
  imu.orientation.y = 0.7;
  imu.orientation.z = -0.1;
  imu.orientation.w = 0.7;
  for (int i = 0; i < 3; ++i)
    imu.orientation_covariance[4 * i] = 0.01 * (i + 1);
  imu.angular_velocity = (geometry_msgs_msg_Vector3){1.0, 2.0, 3.0};
  imu.linear_acceleration = (geometry_msgs_msg_Vector3){4.0, 5.0, 6.0};
  for (;;) {
    dds_write(images, &image);
    dds_write(orientations, &imu);
    dds_sleepfor(DDS_MSECS(50));
  }
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL);
  if (participant < 0) return 3;
  const int status = strcmp(argv[1], "send") == 0 ? send_until_killed(participant) : receive(participant);
  dds_delete(participant);
  return status;
}
