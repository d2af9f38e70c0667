"""Learners of scikit-learn on the features that `cargo xtask export F.dataset --to csv` writes.

python3 docs/validation/learners.py TRAIN.csv... --test TEST.csv...

Each learner trains on what is not of the test split, with every vehicle of every class weighing the same, and is asked
S (the test split), V (vehicles held out in five parts) and T (the files after --test): right answers, mean over classes,
by frame. Needs scikit-learn (BSD licence); no other part of the project does.
"""

import argparse
import csv
import pickle
import time

import numpy as np
from sklearn.ensemble import ExtraTreesClassifier, HistGradientBoostingClassifier, RandomForestClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.neural_network import MLPClassifier
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

CLASSES = ["car", "bus", "truck", "motorcycle"]
KEYS = ["id", "class", "model", "variant", "scene", "target", "frame", "split"]
LEARNERS = {
    "logistic regression": lambda: make_pipeline(StandardScaler(), LogisticRegression(C=0.05, max_iter=2000)),
    "random forest, 400": lambda: RandomForestClassifier(400, min_samples_leaf=3, random_state=1),
    "extra trees, 400": lambda: ExtraTreesClassifier(400, min_samples_leaf=3, max_features=0.3, random_state=1),
    "boosted trees": lambda: HistGradientBoostingClassifier(
        max_iter=150, learning_rate=0.06, max_depth=3, max_features=0.25, random_state=1
    ),
    "network, 64-32": lambda: make_pipeline(
        StandardScaler(), MLPClassifier((64, 32), alpha=1.0, max_iter=300, early_stopping=True, random_state=1)
    ),
}


def read(files):
    rows = [row for file in files for row in csv.DictReader(open(file))]
    names = [key for key in rows[0] if key not in KEYS]
    features = np.array([[float(row[name]) for name in names] for row in rows])
    return features, np.array([CLASSES.index(row["class"]) for row in rows]), rows


def weights(classes, rows):
    models = np.array([row["model"] for row in rows])
    of_vehicle = {pair: 0 for pair in zip(classes, models)}
    for pair in zip(classes, models):
        of_vehicle[pair] += 1
    vehicles = [len([1 for c, _ in of_vehicle if c == k]) for k in range(4)]
    raw = np.array([1 / (vehicles[c] * of_vehicle[(c, m)]) for c, m in zip(classes, models)])
    return raw / raw.mean()


def fit(make, features, classes, rows):
    learner = make()
    last = learner.steps[-1][0] if hasattr(learner, "steps") else None
    if last == "mlpclassifier":
        # It takes no weights: sightings are drawn by them instead.
        share = weights(classes, rows)
        drawn = np.random.default_rng(1).choice(len(classes), len(classes), p=share / share.sum())
        return learner.fit(features[drawn], classes[drawn])
    key = f"{last}__sample_weight" if last else "sample_weight"
    return learner.fit(features, classes, **{key: weights(classes, rows)})


def right(told, truth):
    return np.mean([np.mean(told[truth == c] == c) for c in range(4) if (truth == c).any()])


def held_out(make, features, classes, rows):
    models = np.array([row["model"] for row in rows])
    part = {model: k % 5 for k, model in enumerate(np.random.default_rng(1).permutation(sorted(set(models))))}
    fold = np.array([part[model] for model in models])
    told = np.zeros(len(classes), int)
    for k in range(5):
        kept = fold != k
        learner = fit(make, features[kept], classes[kept], [row for row, keep in zip(rows, kept) if keep])
        told[~kept] = learner.predict(features[~kept])
    return right(told, classes)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("train", nargs="+")
    arguments.add_argument("--test", nargs="*", default=[])
    asked = arguments.parse_args()
    features, classes, rows = read(asked.train)
    test = np.array([row["split"] == "test" for row in rows])
    kept = [row for row, is_test in zip(rows, test) if not is_test]
    others = read(asked.test) if asked.test else None
    print("| learner | S | V | T | training, s | kB | ms each |\n|---|---|---|---|---|---|---|")
    for name, make in LEARNERS.items():
        began = time.process_time()
        learner = fit(make, features[~test], classes[~test], kept)
        trained = time.process_time() - began
        began = time.process_time()
        scenes = right(learner.predict(features[test]), classes[test])
        each = 1000 * (time.process_time() - began) / test.sum()
        vehicles = held_out(make, features[~test], classes[~test], kept)
        foreign = f"{100 * right(learner.predict(others[0]), others[1]):.1f} %" if others else "–"
        size = len(pickle.dumps(learner)) / 1000
        print(f"| {name} | {100 * scenes:.1f} % | {100 * vehicles:.1f} % | {foreign} | {trained:.1f} | {size:.0f} | {each:.2f} |")


main()
