/* An RSU written from idl/bus.idl alone, in C: it joins a run, hears the air in lockstep, asks every car that it hears
 * to speed up a little, and leaves. docs/bus-client.md explains it part by part. It knows the ideal radio only.
 *
 *   lukou run paper --rsu rsu_in_c
 */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <dds/dds.h>

#include "bus.h"

enum { PROTOCOL_VERSION = 1, FRAME_BSM = 1, FRAME_RSC = 5, MOST_TARGETS = 16 };
enum { UP_JOIN = 1, UP_SEES = 2, UP_PROGRESS = 3, UP_LEAVE = 8 };
enum { WELCOME = 1, REFUSE = 2, ROSTER = 3, GRANT = 4, FENCE = 5, ENDED = 6, ABORT = 7 };

struct client {
  uint64_t self; /* incarnation: this start of this program */
  uint32_t rsu;  /* index in the scenario's list */
  char role[16]; /* "rsu0" */
  dds_entity_t participant, waitset, control, up, air, signal, roadside;
  dds_entity_t request; /* 0: the plan is fixed, the controller hears no requests */
  bool welcome, over, failed;
  uint32_t epoch, roster_version;
  bool roster_open;
  int64_t through, next;  /* last step granted, next step to execute */
  uint32_t next_sequence; /* of the next frame */
};

static double now_s(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

static dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "rsu_in_c: cannot create %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

/* ---- the bus ---------------------------------------------------------------------------------------------------- */

static dds_entity_t endpoint(struct client* c, const dds_topic_descriptor_t* type, const char* topic, bool writer,
                             bool stream) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, !writer ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, stream ? 4096 : 512);
  if (writer) dds_qset_writer_data_lifecycle(qos, false);
  if (writer && stream) dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2));
  dds_qset_userdata(qos, &c->self, sizeof c->self);
  dds_entity_t t = made(dds_create_topic(c->participant, type, topic, NULL, NULL), topic);
  dds_entity_t e =
      made(writer ? dds_create_writer(c->participant, t, qos, NULL) : dds_create_reader(c->participant, t, qos, NULL),
           topic);
  dds_delete_qos(qos);
  if (!writer) {
    dds_entity_t news = made(dds_create_readcondition(e, DDS_ANY_STATE), "a read condition");
    dds_waitset_attach(c->waitset, news, news);
  }
  return e;
}

static void join_bus(struct client* c, uint32_t domain, const char* run) {
  char config[1024];
  snprintf(config, sizeof config,
           "<Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
           "<AllowMulticast>false</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize>"
           "<FragmentSize>64000B</FragmentSize></General>"
           "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>"
           "<Peers><Peer Address=\"127.0.0.1\"/></Peers><Tag>lukou-%s</Tag></Discovery></Domain>",
           run);
  made(dds_create_domain(domain, config), "the domain");
  c->participant = made(dds_create_participant(domain, NULL, NULL), "a participant");
  c->waitset = made(dds_create_waitset(c->participant), "a waitset");
  c->control = endpoint(c, &lukou_bus_Control_desc, "lukou/control", false, true);
  c->up = endpoint(c, &lukou_bus_Up_desc, "lukou/up", true, true);
  c->air = endpoint(c, &lukou_bus_Air_desc, "lukou/air", false, false);
  c->signal = endpoint(c, &lukou_bus_Signal_desc, "lukou/signal", false, false);
  c->roadside = endpoint(c, &lukou_bus_Roadside_desc, "lukou/roadside", true, false);
}

static void write_until_done(struct client* c, dds_entity_t writer, const void* sample) {
  while (dds_write(writer, sample) == DDS_RETCODE_TIMEOUT && !c->over) {
  }
}

static void say(struct client* c, int kind, uint64_t number, const char* text) {
  lukou_bus_Up up = {.incarnation = c->self,
                     .kind = (uint8_t)kind,
                     .role = c->role,
                     .protocol = PROTOCOL_VERSION,
                     .number = number,
                     .step = c->next - 1,
                     .text = (char*)text,
                     .hash = ""};
  write_until_done(c, c->up, &up);
}

/* Whether the endpoint is matched with the process of this incarnation. */
static bool sees(dds_entity_t e, bool writer, uint64_t incarnation) {
  dds_instance_handle_t handles[64];
  int count = writer ? dds_get_matched_subscriptions(e, handles, 64) : dds_get_matched_publications(e, handles, 64);
  bool found = false;
  for (int i = 0; i < count && !found; ++i) {
    dds_builtintopic_endpoint_t* other =
        writer ? dds_get_matched_subscription_data(e, handles[i]) : dds_get_matched_publication_data(e, handles[i]);
    void* data = NULL;
    size_t size = 0;
    if (other == NULL) continue;
    if (dds_qget_userdata(other->qos, &data, &size)) {
      found = size == sizeof incarnation && memcmp(data, &incarnation, size) == 0;
      dds_free(data);
    }
    dds_builtintopic_free_endpoint(other);
  }
  return found;
}

/* ---- the step protocol ------------------------------------------------------------------------------------------ */

/* The roster names everybody; before the first grant each one says that it sees all who face it. */
static uint64_t clock_id, engine_id, controller_id;

static void answer_roster(struct client* c) {
  if (!sees(c->control, false, clock_id) || !sees(c->up, true, clock_id)) return;
  if (!sees(c->air, false, engine_id) || !sees(c->roadside, true, engine_id)) return;
  if (!sees(c->signal, false, controller_id)) return;
  if (c->request != 0 && !sees(c->request, true, controller_id)) return;
  c->roster_open = false;
  say(c, UP_SEES, c->roster_version, "");
}

static void obey(struct client* c, const lukou_bus_Control* said) {
  if (said->to != 0 && said->to != c->self) return;
  if (said->kind == WELCOME) {
    c->welcome = true;
    c->epoch = said->epoch;
    clock_id = said->clock;
    if (strstr(said->text, "actuation {") != NULL)
      c->request = endpoint(c, &lukou_bus_Request_desc, "lukou/request", true, false);
  } else if (said->kind == REFUSE || said->kind == ABORT) {
    fprintf(stderr, "rsu_in_c: %s\n", said->text);
    c->over = c->failed = true;
  } else if (said->kind == ROSTER && c->welcome) {
    for (uint32_t i = 0; i < said->roster_incarnation._length; ++i) {
      const char* role = said->roster_role._buffer[i];
      if (strcmp(role, "traffic-engine") == 0) engine_id = said->roster_incarnation._buffer[i];
      if (strcmp(role, "signal-controller") == 0) controller_id = said->roster_incarnation._buffer[i];
    }
    c->roster_version = said->roster_version;
    c->roster_open = true;
  } else if (said->kind == GRANT) {
    c->through = said->through;
    for (uint32_t i = 0; i < said->directive_step._length; ++i)
      fprintf(stderr, "rsu_in_c: from step %lld on %s\n", (long long)said->directive_step._buffer[i],
              said->directive_set._buffer[i]);
  } else if (said->kind == FENCE && said->rsu == c->rsu && said->epoch == c->epoch) {
    c->over = c->failed = true;
  } else if (said->kind == ENDED) {
    c->over = true;
  }
}

static void hear_clock(struct client* c) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  int count;
  while ((count = dds_take(c->control, samples, infos, 16, 16)) > 0) {
    for (int i = 0; i < count; ++i) {
      if (infos[i].valid_data) obey(c, samples[i]);
      if (infos[i].instance_state != DDS_IST_ALIVE && c->welcome && !c->over) c->over = c->failed = true;
    }
    dds_return_loan(c->control, samples, count);
    memset(samples, 0, sizeof samples);
  }
  if (c->roster_open) answer_roster(c);
}

/* The signals are not needed here; but a reader that keeps all has to be emptied. */
static void empty_signal(struct client* c) {
  void* samples[16] = {NULL};
  dds_sample_info_t infos[16];
  int count;
  while ((count = dds_take(c->signal, samples, infos, 16, 16)) > 0) {
    dds_return_loan(c->signal, samples, count);
    memset(samples, 0, sizeof samples);
  }
}

/* ---- the algorithm: an RSC as in idl/v2x.proto, written by hand ------------------------------------------------- */

struct bytes {
  uint8_t* at;
  uint32_t size, room;
};

static void put(struct bytes* b, const void* from, uint32_t size) {
  if (b->size + size > b->room) {
    b->room = 2 * (b->size + size);
    b->at = realloc(b->at, b->room);
    if (b->at == NULL) abort();
  }
  memcpy(b->at + b->size, from, size);
  b->size += size;
}
static void put_byte(struct bytes* b, uint8_t value) { put(b, &value, 1); }
static void put_varint(struct bytes* b, uint64_t value) {
  for (; value >= 128; value >>= 7) put_byte(b, (uint8_t)(value | 128));
  put_byte(b, (uint8_t)value);
}
static void put_number(struct bytes* b, uint32_t field, uint64_t value) {
  put_varint(b, field << 3 | 0);
  put_varint(b, value);
}
static void put_signed(struct bytes* b, uint32_t field, int64_t value) {
  put_number(b, field, (uint64_t)value << 1 ^ (uint64_t)(value >> 63));
}
static void put_id(struct bytes* b, uint32_t field, uint64_t value) { /* fixed64, little-endian */
  put_varint(b, field << 3 | 1);
  for (int i = 0; i < 8; ++i) put_byte(b, (uint8_t)(value >> 8 * i));
}
static void put_message(struct bytes* b, uint32_t field, struct bytes* message) {
  put_varint(b, field << 3 | 2);
  put_varint(b, message->size);
  if (message->size > 0) put(b, message->at, message->size);
  message->size = 0;
}

/* 0.5 m/s2 for 0.2 s, or less if the following law wants less. */
static void put_target(struct bytes* rsc, uint64_t car) {
  static struct bytes vehicle, part, point, path;
  put_id(&vehicle, 1, car);
  put_number(&part, 1, 1U << 12); /* speed up */
  put_number(&part, 2, 20);       /* 10 ms */
  put_message(&vehicle, 2, &part);
  put_signed(&part, 1, 0); /* at the reference position */
  put_signed(&part, 2, 0);
  put_message(&point, 1, &part);
  put_signed(&part, 1, 50); /* 0.01 m/s2 */
  put_message(&point, 4, &part);
  put_message(&path, 1, &point);
  put_message(&vehicle, 3, &path);
  put_number(&vehicle, 100, 1); /* FOLLOWING */
  put_message(rsc, 5, &vehicle);
}

static void execute(struct client* c, const lukou_bus_Air* air) {
  static struct bytes payload, rsc, part, senders, sequences, kinds, sizes, x, y, ends;
  const uint64_t station = UINT64_C(0x5253550000000000) + c->rsu;
  const double origin_m = 0.0;
  const uint8_t kind = FRAME_RSC;
  struct bytes* columns[] = {&payload, &senders, &sequences, &kinds, &sizes, &x, &y, &ends};
  for (size_t i = 0; i < sizeof columns / sizeof *columns; ++i) columns[i]->size = 0;
  uint32_t frames = 0;
  for (uint32_t from = 0, targets = 0; from < air->frames.sender._length || targets > 0; ++from) {
    const bool more = from < air->frames.sender._length;
    if (more && air->frames.kind._buffer[from] == FRAME_BSM) {
      if (targets++ == 0) {
        put_number(&rsc, 1, c->next_sequence % 128);
        put_id(&rsc, 2, station);
        put_number(&rsc, 3, (uint64_t)(air->step % 600 * 100));
        put_signed(&part, 1, 0);
        put_signed(&part, 2, 0);
        put_message(&rsc, 4, &part);
      }
      put_target(&rsc, air->frames.sender._buffer[from]);
    }
    if (targets == MOST_TARGETS || (!more && targets > 0)) {
      const uint32_t wire_bytes = 24 + 31 * targets;
      put(&payload, rsc.at, rsc.size);
      put(&senders, &station, sizeof station);
      put(&sequences, &c->next_sequence, sizeof c->next_sequence);
      put(&kinds, &kind, sizeof kind);
      put(&sizes, &wire_bytes, sizeof wire_bytes);
      put(&x, &origin_m, sizeof origin_m);
      put(&y, &origin_m, sizeof origin_m);
      put(&ends, &payload.size, sizeof payload.size);
      ++c->next_sequence, ++frames;
      rsc.size = 0, targets = 0;
    }
  }
  lukou_bus_Roadside answer;
  memset(&answer, 0, sizeof answer);
  answer.producer = c->self, answer.epoch = c->epoch, answer.step = air->step, answer.rsu = c->rsu;
  answer.frames_heard = air->frames.sender._length;
#define LEND(column, bytes) \
  (column)._buffer = (void*)(bytes).at, (column)._length = (column)._maximum = frames, (column)._release = false
  LEND(answer.frames.sender, senders), LEND(answer.frames.sequence_number, sequences);
  LEND(answer.frames.kind, kinds), LEND(answer.frames.wire_bytes, sizes);
  LEND(answer.frames.antenna_x_m, x), LEND(answer.frames.antenna_y_m, y);
  LEND(answer.frames.payload_end, ends), LEND(answer.frames.payload, payload);
  answer.frames.payload._length = answer.frames.payload._maximum = payload.size;
  write_until_done(c, c->roadside, &answer);
  if (c->request == 0) return;
  /* It asks for no greens; the controller waits for its word all the same. */
  lukou_bus_Request request;
  memset(&request, 0, sizeof request);
  request.producer = c->self, request.epoch = c->epoch, request.step = air->step, request.rsu = c->rsu;
  write_until_done(c, c->request, &request);
}

/* Takes the next batch of the air if the clock has granted its step. */
static bool step(struct client* c) {
  void* sample = NULL;
  dds_sample_info_t info;
  if (c->next > c->through || dds_take(c->air, &sample, &info, 1, 1) != 1) return false;
  if (info.valid_data) {
    const lukou_bus_Air* air = sample;
    if (air->step != c->next) {
      fprintf(stderr, "rsu_in_c: expected step %lld, got %lld\n", (long long)c->next, (long long)air->step);
      exit(1);
    }
    execute(c, air);
    ++c->next;
  }
  dds_return_loan(c->air, &sample, 1);
  return info.valid_data;
}

int main(void) {
  const char *run = getenv("LUKOU_RUN"), *domain = getenv("LUKOU_DOMAIN"), *rsu = getenv("LUKOU_RSU");
  if (run == NULL || domain == NULL) {
    fprintf(stderr, "rsu_in_c: LUKOU_RUN and LUKOU_DOMAIN name the run; start it by lukou run SCENARIO --rsu\n");
    return 2;
  }
  struct client c = {.through = -1};
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  c.self =
      ((uint64_t)now.tv_sec << 30 | (uint64_t)now.tv_nsec) * UINT64_C(0x9E3779B97F4A7C15); /* no other start has it */
  c.rsu = rsu == NULL ? 0 : (uint32_t)atoi(rsu);
  snprintf(c.role, sizeof c.role, "rsu%u", (unsigned)c.rsu);
  join_bus(&c, (uint32_t)atoi(domain), run);

  double said_s = 0.0;
  while (!c.over) {
    hear_clock(&c);
    empty_signal(&c);
    if (step(&c)) continue;
    if (now_s() - said_s >= (c.welcome ? 0.2 : 0.05)) {
      said_s = now_s();
      if (!c.welcome)
        say(&c, UP_JOIN, 0, "");
      else
        say(&c, UP_PROGRESS, 0, c.next > c.through ? "clock" : "traffic-engine");
    }
    dds_attach_t woken;
    dds_waitset_wait(c.waitset, &woken, 1, c.roster_open || !c.welcome ? DDS_MSECS(10) : DDS_MSECS(100));
  }
  say(&c, UP_LEAVE, 0, "");
  dds_wait_for_acks(c.up, DDS_SECS(1));
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return c.failed ? 3 : 0;
}
