/* The access control of DDS Security as an attacker would have it: the real plugin, except that its own process may
 * create whatever it likes. What the others let it do is then theirs to decide.
 *
 * LUKOU_REAL_ACCESS_CONTROL names the real plugin's file. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#include <dds/security/dds_security_api.h>

static plugin_finalize real_finalize;

static DDS_Security_boolean any_writer(dds_security_access_control* instance, const DDS_Security_PermissionsHandle own,
                                       const DDS_Security_DomainId domain, const DDS_Security_char* topic,
                                       const DDS_Security_Qos* qos, const DDS_Security_PartitionQosPolicy* partition,
                                       const DDS_Security_DataTags* tag, DDS_Security_SecurityException* ex) {
  (void)instance, (void)own, (void)domain, (void)topic, (void)qos, (void)partition, (void)tag, (void)ex;
  return true;
}

static DDS_Security_boolean any_topic(dds_security_access_control* instance, const DDS_Security_PermissionsHandle own,
                                      const DDS_Security_DomainId domain, const DDS_Security_char* topic,
                                      const DDS_Security_Qos* qos, DDS_Security_SecurityException* ex) {
  (void)instance, (void)own, (void)domain, (void)topic, (void)qos, (void)ex;
  return true;
}

int init_access_control(const char* argument, void** context, struct ddsi_domaingv* gv) {
  const char* file = getenv("LUKOU_REAL_ACCESS_CONTROL");
  void* library = file == NULL ? NULL : dlopen(file, RTLD_NOW);
  if (library == NULL) {
    fprintf(stderr, "lax_access_control: %s\n", file == NULL ? "LUKOU_REAL_ACCESS_CONTROL is not set" : dlerror());
    return -1;
  }
  plugin_init real_init = (plugin_init)dlsym(library, "init_access_control");
  real_finalize = (plugin_finalize)dlsym(library, "finalize_access_control");
  const int result = real_init(argument, context, gv);
  if (result != 0) return result;
  dds_security_access_control* real = *context;
  real->check_create_datawriter = any_writer;
  real->check_create_datareader = any_writer;
  real->check_create_topic = any_topic;
  return 0;
}

int finalize_access_control(void* context) { return real_finalize(context); }
