/* A stranger on the bus: takes part in a domain as its CYCLONEDDS_URI says, reads and writes what it is told to for a
 * while, and prints how far it came.
 *
 *   intruder DOMAIN SECONDS read:TOPIC ... write:TOPIC ...     topics without their "lukou/"
 *
 * A line each: "read traffic created 1 matched 1 samples 42", "write up created 1 matched 1 written 20"; matched: the
 * most at once. It asks the clock to stop (up), turns all lights green (signal) and forges empty batches. Alone it
 * prints "participant refused". */
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <dds/dds.h>

#include "bus.h"

enum { SELF = 666, MOST = 16, UP_REQUEST = 6, GREEN = 3, LANES = 12, PROMISED = 11 };

static uint8_t all_green[LANES * PROMISED];
static lukou_bus_Up stop = {.incarnation = SELF,
                            .kind = UP_REQUEST,
                            .role = "observer",
                            .protocol = 1,
                            .number = 1,
                            .text = "stop",
                            .hash = ""};
static lukou_bus_Signal green = {
    .producer = SELF, .epoch = 1, .heads = {sizeof all_green, sizeof all_green, all_green, false}};
static lukou_bus_Traffic traffic = {.producer = SELF, .epoch = 1};
static lukou_bus_Air air = {.producer = SELF, .epoch = 1};
static lukou_bus_Roadside roadside = {.producer = SELF, .epoch = 1};
static lukou_bus_View view = {.producer = SELF};

static const struct kind {
  const char* name;
  const dds_topic_descriptor_t* type;
  void* forged; /* NULL: it only reads it */
} kinds[] = {{"up", &lukou_bus_Up_desc, &stop},
             {"signal", &lukou_bus_Signal_desc, &green},
             {"traffic", &lukou_bus_Traffic_desc, &traffic},
             {"air", &lukou_bus_Air_desc, &air},
             {"roadside", &lukou_bus_Roadside_desc, &roadside},
             {"view", &lukou_bus_View_desc, &view},
             {"control", &lukou_bus_Control_desc, NULL},
             {"run_state", &lukou_bus_RunState_desc, NULL}};

struct end {
  const struct kind* kind;
  bool writes;
  dds_entity_t entity; /* below 0: refused */
  int matched;         /* the most at once */
  long count;          /* samples received or written */
};

static struct end ends[MOST];
static int end_count;

static void add(dds_entity_t participant, const char* word) {
  struct end* e = &ends[end_count];
  e->writes = strncmp(word, "write:", 6) == 0;
  const char* name = strchr(word, ':');
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; ++i)
    if (name != NULL && strcmp(kinds[i].name, name + 1) == 0) e->kind = &kinds[i];
  if (e->kind == NULL || (e->writes && e->kind->forged == NULL)) {
    fprintf(stderr, "intruder: what is %s?\n", word);
    exit(2);
  }
  ++end_count;
  char topic_name[32];
  snprintf(topic_name, sizeof topic_name, "lukou/%s", e->kind->name);
  dds_qos_t* qos = dds_create_qos();
  /* As the readers and writers that it wants to be taken for; a best-effort reader is no burden to anybody. */
  dds_qset_reliability(qos, e->writes ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(10));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const uint64_t self = SELF;
  dds_qset_userdata(qos, &self, sizeof self);             /* or the clock does not know whom to answer */
  dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT); /* he is after the others */
  if (e->writes) dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2));
  const dds_entity_t topic = dds_create_topic(participant, e->kind->type, topic_name, NULL, NULL);
  e->entity = topic < 0   ? topic
              : e->writes ? dds_create_writer(participant, topic, qos, NULL)
                          : dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
}

static void act(struct end* e) {
  if (e->entity < 0) return;
  dds_instance_handle_t handles[64];
  const int matched = e->writes ? dds_get_matched_subscriptions(e->entity, handles, 64)
                                : dds_get_matched_publications(e->entity, handles, 64);
  if (matched > e->matched) e->matched = matched;
  if (e->writes) {
    e->count += dds_write(e->entity, e->kind->forged) == DDS_RETCODE_OK;
    return;
  }
  void* samples[MOST] = {NULL};
  dds_sample_info_t infos[MOST];
  for (int taken = MOST; taken == MOST;) {
    taken = dds_take(e->entity, samples, infos, MOST, MOST);
    for (int i = 0; i < taken; ++i) e->count += infos[i].valid_data;
    if (taken > 0) dds_return_loan(e->entity, samples, taken);
    memset(samples, 0, sizeof samples);
  }
}

int main(int argc, char** argv) {
  if (argc < 4 || argc - 3 > MOST) {
    fprintf(stderr, "intruder DOMAIN SECONDS read:TOPIC ... write:TOPIC ...\n");
    return 2;
  }
  memset(all_green, GREEN, sizeof all_green);
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  if (participant < 0) {
    printf("participant refused\n");
    return 0;
  }
  for (int i = 3; i < argc; ++i) add(participant, argv[i]);
  for (int ticks = 20 * atoi(argv[2]); ticks > 0; --ticks) {
    for (int i = 0; i < end_count; ++i) act(&ends[i]);
    dds_sleepfor(DDS_MSECS(50));
  }
  for (int i = 0; i < end_count; ++i)
    printf("%s %s created %d matched %d %s %ld\n", ends[i].writes ? "write" : "read", ends[i].kind->name,
           ends[i].entity > 0, ends[i].matched, ends[i].writes ? "written" : "samples", ends[i].count);
  dds_delete(participant);
  return 0;
}
