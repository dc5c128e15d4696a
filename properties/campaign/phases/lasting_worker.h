// One process of a plug-in that is loaded before the first trial and asked again at the very end of
// a campaign. A plug-in may answer otherwise once it has been loaded for a while, or has been used
// for long. Nothing else would see it: the processes of the trials end with the trials.
#pragma once

#include <vector>

#include "corpus/cases/case_file.h"
#include "properties/campaign/ledger/store.h"
#include "properties/campaign/request.h"
#include "properties/worker/worker_process.h"

namespace assay::properties {

// REQUIRES a plug-in. The process dies with the thread that started it, so one thread calls all of
// the functions.
class LastingWorker {
 public:
  explicit LastingWorker(const CampaignRequest& request);

  // Starts the process and puts cases of trials to it: of each family the first that this run
  // judges, up to two that it answers with a collision and one that it calls free. They are
  // remembered. The trials themselves judge these cases, in other processes. A case that has no end
  // by itself is not remembered, and after it no other case is put.
  void begin();

  // The process. It may run as many threads as the first run of large meshes (threads_of_runs).
  WorkerProcess& process() { return process_; }

  // This case will be asked again. `first` is what the process answered; the case as the contract
  // has it.
  void remember(const corpus::Case& c, CaseRun first);

  // Asks the process for all remembered cases again, the last one first. An answer that is not the
  // first one is judged anew, by the oracle and by the claim `deterministic`. If it breaks a claim,
  // that is a failure of the run. After three cases without an answer it stops asking. What this
  // came to is stored. Throws StoreProblem.
  AskedAgain ask_again(Store& store);

 private:
  struct Remembered {
    corpus::Case c;
    CaseRun first;
  };
  const Configuration& configuration() const { return request_.detector.configurations.front(); }
  CaseRun run(const corpus::Case& c);
  bool put_first_cases(const StratumPlan& stratum);
  void judge_anew(const Remembered& asked, const CaseRun& run, AskedAgain& row, Store& store) const;

  const CampaignRequest& request_;
  WorkerProcess process_;
  std::vector<Remembered> remembered_;
};

}  // namespace assay::properties
