from paintlink.instrument import confirm


def test_operator_who_can_answer_is_waited_for():
    class Operator:
        told, waited = [], []

        def __call__(self, sentence):
            self.told.append(sentence)

        def confirm(self, sentence):
            self.waited.append(sentence)

    operator = Operator()
    confirm(operator, "Set it on the plaque.")

    assert (operator.told, operator.waited) == ([], ["Set it on the plaque."])


def test_plain_prompt_is_told_and_not_waited_for():
    told = []

    confirm(told.append, "Set it on the plaque.")

    assert told == ["Set it on the plaque."]
